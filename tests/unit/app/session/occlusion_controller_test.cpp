#include "app/session/occlusion_controller.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "core/io/models/glb.h"
#include "tests/support/cheek.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using testing::bite_relation;
using testing::Cheek;
using testing::coarse_jaw;

/// Stages whose scans lie in a case, and were finished there.
class JawsOfACase : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    upper_ = coarse_jaw(JawKind::kUpper, 3);
    lower_ = coarse_jaw(JawKind::kLower, 3);
    bite_ = Cheek(upper_, lower_, bite_relation(), true, 1).mesh();
    left_ = Cheek(upper_, lower_, bite_relation(), false, 2).mesh();
  }
  static void TearDownTestSuite() { upper_ = lower_ = bite_ = left_ = {}; }

  /// A case with these models, chosen in the window.
  void open(const std::vector<std::pair<io::ScanStage, const TriangleMesh*>>& models) {
    const std::string name = "bite" + std::to_string(++case_count_) + ".flytri";
    auto file = io::CaseFile::create(folder_.path() / name, {});
    ASSERT_TRUE(file);
    for (const auto& [stage, mesh] : models) {
      const auto glb = io::encode_glb({*mesh, {}, {}}, "jaw");
      ASSERT_TRUE(file->write_result(stage, {glb.value(), "{}", io::ResultBasis{}}));
    }
    stages_.replace_by(std::make_shared<CaseStore>(std::move(*file)));
  }
  ui::OcclusionState wait_for_end() {
    ui::OcclusionState state = controller_.state();
    while (state.is_running) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      background_.settle();
      state = controller_.state();
    }
    return state;
  }

  /// With all that is needed, and with this second bite.
  void open_with(const TriangleMesh& second) {
    open({{io::ScanStage::kUpper, &upper_},
          {io::ScanStage::kLower, &lower_},
          {io::ScanStage::kBite, &bite_},
          {io::ScanStage::kBite2, &second}});
  }

  static inline TriangleMesh upper_, lower_, bite_, left_;
  int case_count_ = 0;
  TemporaryFolder folder_;
  ui::Texts texts_;
  Notices notices_{texts_};
  BackgroundWork background_;
  SourceController source_{{}, background_, notices_, [] {}};
  StageController stages_{{}, source_, background_, notices_};
  OcclusionController controller_{stages_, background_, notices_};
};

TEST_F(JawsOfACase, ClosesTheJawsOfACaseOnceTheBiteIsShown) {
  open({{io::ScanStage::kUpper, &upper_},
        {io::ScanStage::kLower, &lower_},
        {io::ScanStage::kBite, &bite_}});
  EXPECT_FALSE(controller_.state().is_running) << "the upper jaw is shown";
  stages_.select(io::ScanStage::kBite);
  EXPECT_TRUE(controller_.state().is_running);
  const ui::OcclusionState state = wait_for_end();
  ASSERT_NE(state.pair, nullptr) << state.failure;
  EXPECT_LT(state.middle_uncertainty_mm, state.far_uncertainty_mm);

  // The lower jaw lies where it bites.
  const SurfacePoint& shown = state.pair->mesh.mesh.vertices[state.pair->first_lower];
  const Vec3 expected_mm = bite_relation() * lower_.vertices.front().position_mm.cast<double>();
  EXPECT_LT((shown.position_mm.cast<double>() - expected_mm).norm(), 0.1);
  EXPECT_EQ(state.pair->clearance_mm.size(), state.pair->mesh.mesh.vertices.size());
  EXPECT_EQ(controller_.state().pair, state.pair) << "nothing has changed";
}

TEST_F(JawsOfACase, ASecondBiteMakesTheFarSideCertain) {
  open({{io::ScanStage::kUpper, &upper_},
        {io::ScanStage::kLower, &lower_},
        {io::ScanStage::kBite, &bite_}});
  stages_.select(io::ScanStage::kBite);
  (void)controller_.state();
  const ui::OcclusionState alone = wait_for_end();
  ASSERT_NE(alone.pair, nullptr) << alone.failure;
  EXPECT_EQ(alone.bite_count, 1U);

  open_with(left_);
  stages_.select(io::ScanStage::kBite2);
  EXPECT_TRUE(controller_.state().is_running) << "either bite shows the jaws";
  const ui::OcclusionState both = wait_for_end();
  ASSERT_NE(both.pair, nullptr) << both.failure;
  EXPECT_EQ(both.bite_count, 2U);
  EXPECT_FALSE(both.bites_are_on_one_side);
  EXPECT_LT(both.far_uncertainty_mm, 0.5 * alone.far_uncertainty_mm);
  stages_.select(io::ScanStage::kBite);
  EXPECT_EQ(controller_.state().pair, both.pair) << "nothing has changed";
}

TEST_F(JawsOfACase, TheSecondBiteAloneIsEnough) {
  open({{io::ScanStage::kUpper, &upper_},
        {io::ScanStage::kLower, &lower_},
        {io::ScanStage::kBite2, &left_}});
  stages_.select(io::ScanStage::kBite);
  EXPECT_FALSE(controller_.state().is_running) << "this bite is not finished";
  stages_.select(io::ScanStage::kBite2);
  EXPECT_TRUE(controller_.state().is_running);
  const ui::OcclusionState state = wait_for_end();
  ASSERT_NE(state.pair, nullptr) << state.failure;
  EXPECT_EQ(state.bite_count, 1U);
}

TEST_F(JawsOfACase, KnowsThatBothBitesAreOfOneSide) {
  const TriangleMesh again = Cheek(upper_, lower_, bite_relation(), true, 7).mesh();
  open_with(again);
  stages_.select(io::ScanStage::kBite);
  (void)controller_.state();
  const ui::OcclusionState state = wait_for_end();
  ASSERT_NE(state.pair, nullptr) << state.failure;
  EXPECT_TRUE(state.bites_are_on_one_side);
}

TEST_F(JawsOfACase, NamesTheBitesThatContradictEachOther) {
  // The patient has moved the jaw by a millimeter in between.
  const Isometry T_moved = Eigen::Translation3d(1.0, 0.5, 0.3) * bite_relation();
  const TriangleMesh moved = Cheek(upper_, lower_, T_moved, false, 2).mesh();
  open_with(moved);
  stages_.select(io::ScanStage::kBite2);
  (void)controller_.state();
  const ui::OcclusionState state = wait_for_end();
  EXPECT_EQ(state.pair, nullptr);
  EXPECT_NE(state.failure.find("Bite and Bite, other side contradict each other"),
            std::string::npos)
      << state.failure;
}

TEST_F(JawsOfACase, WaitsForAllThreeModels) {
  open({{io::ScanStage::kUpper, &upper_}, {io::ScanStage::kBite, &bite_}});
  stages_.select(io::ScanStage::kBite);
  EXPECT_FALSE(controller_.state().is_running);
  EXPECT_EQ(controller_.state().pair, nullptr);
}

TEST_F(JawsOfACase, SaysWhyTheBiteDoesNotFit) {
  // Twice the upper jaw: the bite does not lie on the second one.
  open({{io::ScanStage::kUpper, &upper_},
        {io::ScanStage::kLower, &upper_},
        {io::ScanStage::kBite, &bite_}});
  stages_.select(io::ScanStage::kBite);
  EXPECT_TRUE(controller_.state().is_running);
  const ui::OcclusionState state = wait_for_end();
  EXPECT_EQ(state.pair, nullptr);
  EXPECT_NE(state.failure.find("Bite"), std::string::npos) << state.failure;
  EXPECT_FALSE(controller_.state().is_running) << "it is tried again only with other models";
}

TEST_F(JawsOfACase, ForgetsTheJawsOfAnotherCase) {
  open({{io::ScanStage::kUpper, &upper_},
        {io::ScanStage::kLower, &lower_},
        {io::ScanStage::kBite, &bite_}});
  stages_.select(io::ScanStage::kBite);
  EXPECT_TRUE(controller_.state().is_running);
  ASSERT_NE(wait_for_end().pair, nullptr);
  stages_.replace_by(nullptr);
  EXPECT_EQ(controller_.state().pair, nullptr);
}

}  // namespace
}  // namespace flytri::session
