#include "app/session/review_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/session/export_files.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/reconstruct/margin_files.h"
#include "core/review/margin_renewal.h"
#include "tests/support/revolved.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using ::testing::HasSubstr;
using testing::Preparation;
using testing::preparation;

constexpr auto kReviewedStage = io::ScanStage::kUpper;

/// A case whose upper jaw is finished: a prepared tooth.
class ReviewOfACase : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    tooth_ = preparation({});
    mesh_ = review::made_ready(tooth_.mesh);
  }
  void SetUp() override {
    ASSERT_TRUE(io::CaseFile::create(path_, {}));
    open(tooth_.mesh);
  }
  /// Opens the case with this model, as after another Finish.
  void open(const TriangleMesh& model) {
    stages_.replace_by(nullptr);
    auto file = io::CaseFile::open(path_);
    ASSERT_TRUE(file);
    const auto glb = io::encode_glb({model, {}, {}}, "jaw");
    ASSERT_TRUE(file->write_result(kReviewedStage, {glb.value(), "{}", io::ResultBasis{}}));
    stages_.replace_by(std::make_shared<CaseStore>(std::move(*file)));
    wait_until([&] { return stages_.model_of(kReviewedStage).scan != nullptr; });
  }
  template <typename Condition>
  ui::ReviewState wait_until(const Condition& is_done) {
    ui::ReviewState state = controller_.state();
    for (int i = 0; i < 3000 && !is_done(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      background_.settle();
      state = controller_.state();
    }
    EXPECT_TRUE(is_done());
    return state;
  }
  ui::ReviewState wait_for_end() {
    ui::ReviewState state = controller_.state();
    return wait_until([&] {
      state = controller_.state();
      return !state.is_running && !state.is_checking;
    });
  }
  static std::vector<Vec3> clicks(std::size_t count = 5) {
    std::vector<Vec3> clicks_mm;
    for (std::size_t i = 0; i < count; ++i)
      clicks_mm.push_back(tooth_.margin_mm[i * tooth_.margin_mm.size() / 5]);
    return clicks_mm;
  }
  void draw_and_keep() {
    controller_.draw_margin({clicks()});
    ASSERT_NE(wait_for_end().drawn, nullptr);
    controller_.keep_margin();
  }

  static inline Preparation tooth_;
  static inline TriangleMesh mesh_;
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "prepared.flytri";
  ui::Texts texts_;
  Notices notices_{texts_};
  BackgroundWork background_;
  SourceController source_{{}, background_, notices_, [] {}};
  StageController stages_{{}, source_, background_, notices_};
  ReviewController controller_{stages_, background_};
};

TEST_F(ReviewOfACase, MeasuresWhatTheLibraryMeasures) {
  const MeshDistance distance(mesh_);
  const std::array points_mm = {tooth_.margin_mm[0], tooth_.margin_mm[300], tooth_.margin_mm[600]};
  stages_.add_measurement({0, points_mm[0], points_mm[2], {}});
  controller_.measure_angle({points_mm});
  const review::Plane plane = {Vec3::Zero(), Vec3::UnitX()};
  controller_.cut({plane, {points_mm[0], points_mm[1]}});
  controller_.find_undercut({{Vec3(0.1, 0.0, 1.0), Vec3::Zero(), 5.0}});
  const ui::ReviewState state = wait_for_end();

  ASSERT_EQ(state.distances_mm.size(), 1U);
  const std::array ends_mm = {points_mm[0], points_mm[2]};
  const review::Measured length = review::reviewed_number(mesh_, distance, ends_mm).measured;
  EXPECT_NEAR(state.distances_mm[0].value, length.value, 1e-6);
  EXPECT_NEAR(state.distances_mm[0].uncertainty, length.uncertainty, 1e-6);
  EXPECT_GT(length.uncertainty, 0.0);

  ASSERT_EQ(state.angles_rad.size(), 1U);
  EXPECT_NEAR(state.angles_rad[0].measured.value,
              review::reviewed_number(mesh_, distance, points_mm).measured.value, 1e-6);

  ASSERT_NE(state.section, nullptr) << state.section_failure;
  const auto section =
      review::reviewed_section(mesh_, plane, std::array{points_mm[0], points_mm[1]}).value();
  EXPECT_EQ(state.section->outlines.size(), section.outlines.size());
  EXPECT_NEAR(
      review::distance_mm(state.section->places[0].point, state.section->places[1].point).value,
      review::distance_mm(section.places[0].point, section.places[1].point).value, 1e-6);

  ASSERT_NE(state.undercut, nullptr) << state.undercut_failure;
  const auto undercut =
      review::reviewed_undercut(mesh_, {Vec3(0.1, 0.0, 1.0), Vec3::Zero(), 5.0}, Workers()).value();
  EXPECT_NEAR(state.undercut->reviewed.undercut.area_mm2.value, undercut.undercut.area_mm2.value,
              1e-6);
  EXPECT_EQ(state.undercut->depth_mm.size(), tooth_.mesh.vertices.size());

  controller_.remove_angle(0);
  EXPECT_TRUE(controller_.state().angles_rad.empty());
}

TEST_F(ReviewOfACase, AMarginLineSurvivesClosingTheCase) {
  controller_.draw_margin({clicks(2)});
  EXPECT_EQ(wait_for_end().drawn, nullptr) << "two clicks are too few";
  draw_and_keep();
  const ui::ReviewState kept = controller_.state();
  ASSERT_EQ(kept.margins.size(), 1U);
  EXPECT_EQ(kept.drawn, nullptr);

  stages_.replace_by(nullptr);
  EXPECT_TRUE(controller_.state().margins.empty());
  stages_.replace_by(std::make_shared<CaseStore>(io::CaseFile::open(path_).value()));
  wait_until([&] { return stages_.model_of(kReviewedStage).scan != nullptr; });
  const ui::ReviewState again = wait_for_end();
  ASSERT_EQ(again.margins.size(), 1U);
  EXPECT_FALSE(again.margins[0].is_outdated);
  EXPECT_EQ(again.margins[0].margin->line.points[0].position_mm,
            kept.margins[0].margin->line.points[0].position_mm);

  controller_.remove_margin(0);
  EXPECT_TRUE(controller_.state().margins.empty());
}

TEST_F(ReviewOfACase, AMarginLineFollowsAModelThatIsFinishedAgain) {
  draw_and_keep();
  const auto former = controller_.state().margins[0].margin;
  const TriangleMesh newer = preparation({.seed = 5}).mesh;
  open(newer);
  const ui::ReviewState state = wait_for_end();
  ASSERT_EQ(state.margins.size(), 1U);
  EXPECT_FALSE(state.margins[0].is_outdated);
  const MeshDistance surface(review::made_ready(newer));
  EXPECT_TRUE(review::lies_on(state.margins[0].margin->line, surface));
  EXPECT_FALSE(review::lies_on(former->line, surface));
  // The case has the new line.
  const auto stored = stages_.margins();
  ASSERT_EQ(stored.size(), 1U);
  EXPECT_TRUE(review::lies_on(stored[0].margin.line, surface));
}

TEST_F(ReviewOfACase, AMarginLineWhoseEdgeIsGoneIsOutdatedAndNotExported) {
  draw_and_keep();
  TriangleMesh elsewhere = tooth_.mesh;
  for (SurfacePoint& vertex : elsewhere.vertices) vertex.position_mm.x() += 3.0F;
  open(elsewhere);
  const ui::ReviewState state = wait_for_end();
  ASSERT_EQ(state.margins.size(), 1U);
  EXPECT_TRUE(state.margins[0].is_outdated);
  const auto margins = reconstruct::margins_on(elsewhere, stages_.margins(), Workers());
  EXPECT_TRUE(margins.lines.empty());
  EXPECT_EQ(margins.outdated, 1U);
}

TEST_F(ReviewOfACase, AMarginLineIsExportedBesideTheModel) {
  draw_and_keep();
  scan::ScanSnapshot shown;
  shown.result = stages_.model_of(kReviewedStage).scan;
  ui::Export command{{folder_.path().string(), "tooth", {".stl", ".obj"}}, {}};
  std::vector<std::filesystem::path> models;
  const auto outcome = export_files({shown, stages_.margins()}, command, models);
  ASSERT_TRUE(outcome) << outcome.error().message;
  const std::filesystem::path file = folder_ / "tooth-margin.obj";
  EXPECT_EQ(outcome->written.back().path, file.string());
  EXPECT_EQ(models.back(), file);
  const std::string text = io::read_file(file).value();
  EXPECT_THAT(text, HasSubstr("o margin-1\n"));
  const auto points = static_cast<long>(stages_.margins()[0].margin.line.points.size());
  EXPECT_EQ(std::count(text.begin(), text.end(), 'v'), points);

  const auto again = export_files({shown, stages_.margins()}, command, models);
  ASSERT_TRUE(again);
  EXPECT_THAT(again->existing, ::testing::Contains(file.string())) << "it is asked for, too";
}

TEST_F(ReviewOfACase, SaysWhyThereIsNoMarginLine) {
  controller_.draw_margin({{Vec3(2.9, 0.0, 2.0), Vec3(0.0, 2.5, 2.0), Vec3(-2.9, 0.0, 2.0)}});
  const ui::ReviewState state = wait_for_end();
  EXPECT_EQ(state.drawn, nullptr);
  EXPECT_FALSE(state.margin_failure.empty());
  controller_.draw_margin({{}});
  EXPECT_TRUE(controller_.state().margin_failure.empty());
}

}  // namespace
}  // namespace flytri::session
