/// @file  Measuring on a finished model of a case, and its margin lines, through a session.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "app/session/session.h"
#include "app/session/user_folders.h"
#include "core/evaluation/surface_error.h"
#include "core/io/models/glb.h"
#include "core/io/models/model.h"
#include "core/io/models/ply.h"
#include "core/review/measure.h"
#include "tests/support/fake_jaw.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/app/session/session_fixture.h"

namespace flytri::session {
namespace {

/// A case with the simulated sensor's calibration and a finished upper jaw, one molar of which is
/// prepared for a crown.
class SessionReview : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { jaw_ = testing::FakeJaw().prepared_jaw(); }
  static void TearDownTestSuite() { jaw_ = {}; }

  void SetUp() override {
    for (const char* const folder : {"XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME"})
      setenv(folder, folder_.path().c_str(), 1);
    options_.unnamed_folder = unnamed_cases_folder();
    options_.source = {};
    // The jaw is in the case. The virtual sensor sees a plane: that is quick.
    const fs::path object = folder_.path() / "object.ply";
    ASSERT_TRUE(io::write_ply(object, height_field({}, [](double, double) { return 0.0; })));
    options_.source.object.mesh = object;
    {
      Session session(options_);
      ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
      session.carry_out(ui::NewCase{path(), {}, {}});
      ASSERT_TRUE(wait_for(session, [&](const auto& view) { return view.file.path == path(); }));
    }
    finish(jaw_.mesh);
  }

  [[nodiscard]] std::string path() const { return (folder_.path() / "jaw.flytri").string(); }

  /// The case has this model from now on.
  void finish(const TriangleMesh& mesh) const {
    auto file = io::CaseFile::open(path(), {});
    ASSERT_TRUE(file) << file.error().message;
    const auto glb = io::encode_glb({mesh, {}, {}}, "jaw");
    ASSERT_TRUE(glb);
    ASSERT_TRUE(file->write_result(io::ScanStage::kUpper, {*glb, "{}", io::ResultBasis{}}));
    ASSERT_TRUE(file->commit());
  }

  [[nodiscard]] bool open(Session& session) const {
    session.carry_out(ui::OpenCase{path(), {}});
    return wait_for(session, [](const ui::AppView& view) {
      return view.scan != nullptr && view.scan->result != nullptr;
    });
  }
  static bool wait_for_margin(Session& session) {
    return wait_for(session, [](const ui::AppView& view) {
      return !view.review.margins.empty() && !view.review.is_checking;
    });
  }
  /// Places on the true margin.
  static std::vector<Vec3> clicks_mm() {
    std::vector<Vec3> clicks;
    for (std::size_t k = 0; k < 5; ++k)
      clicks.push_back(jaw_.margin_mm[k * jaw_.margin_mm.size() / 5]);
    return clicks;
  }
  void draw_and_keep(Session& session) const {
    ASSERT_TRUE(open(session));
    session.carry_out(ui::DrawMargin{clicks_mm()});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.review.drawn != nullptr; }))
        << session.view().review.margin_failure;
    session.carry_out(ui::KeepMargin{});
    ASSERT_TRUE(wait_for_margin(session));
    EXPECT_EQ(session.view().review.drawn, nullptr);
  }
  /// Mean distance of a margin's points from the true one.
  static double off_mm(const review::Margin& margin, const Vec3& moved_mm) {
    double sum = 0.0;
    for (const review::MeasuredPoint& point : margin.line.points) {
      double nearest = 1e9;
      for (const Vec3& p : jaw_.margin_mm)
        nearest = std::min(nearest, (p + moved_mm - point.position_mm).norm());
      sum += nearest;
    }
    return sum / static_cast<double>(margin.line.points.size());
  }

  static inline testing::PreparedJaw jaw_;
  TemporaryFolder folder_;
  SessionOptions options_;
};

TEST_F(SessionReview, AKeptMarginIsThereWhenTheCaseIsOpenedAgain) {
  double length_mm = 0.0;
  {
    Session session(options_);
    draw_and_keep(session);
    length_mm = review::length_mm(session.view().review.margins.front().margin->line).value;
  }
  EXPECT_GT(length_mm, 15.0);
  Session session(options_);
  ASSERT_TRUE(open(session));
  ASSERT_TRUE(wait_for_margin(session));
  const auto margins = session.view().review.margins;
  ASSERT_EQ(margins.size(), 1U);
  EXPECT_FALSE(margins.front().is_outdated);
  EXPECT_NEAR(review::length_mm(margins.front().margin->line).value, length_mm, 1e-6);

  session.carry_out(ui::RemoveMargin{0});
  EXPECT_TRUE(wait_for(session, [](const auto& view) { return view.review.margins.empty(); }));
}

TEST_F(SessionReview, AMarginIsDrawnAnewOnANewerModel) {
  {
    Session session(options_);
    draw_and_keep(session);
  }
  const Vec3 moved_mm(0.03, -0.02, 0.04);
  finish(evaluation::transformed(jaw_.mesh, Isometry(Eigen::Translation3d(moved_mm))));
  for (int opened = 0; opened < 2; ++opened) {
    Session session(options_);
    ASSERT_TRUE(open(session));
    ASSERT_TRUE(wait_for_margin(session));
    const auto margins = session.view().review.margins;
    ASSERT_EQ(margins.size(), 1U);
    EXPECT_FALSE(margins.front().is_outdated);
    EXPECT_LT(off_mm(*margins.front().margin, moved_mm), 0.1) << opened;
  }
}

TEST_F(SessionReview, AMarginWithoutItsToothIsOutdatedAndNotExported) {
  {
    Session session(options_);
    draw_and_keep(session);
  }
  TriangleMesh without = jaw_.mesh;
  std::erase_if(without.triangles, [&](const Triangle& t) {
    const Vec3 p_mm = without.vertices[t[0]].position_mm.cast<double>();
    return (p_mm - jaw_.tooth_mm).norm() < 9.0;
  });
  finish(without);
  Session session(options_);
  ASSERT_TRUE(open(session));
  ASSERT_TRUE(wait_for_margin(session));
  ASSERT_EQ(session.view().review.margins.size(), 1U);
  EXPECT_TRUE(session.view().review.margins.front().is_outdated);
  const ui::ExportTarget target = {folder_.path().string(),         "jaw", {".ply"},
                                   reconstruct::MeshDensity::kFull, false, false};
  session.carry_out(ui::Export{target, {}});
  ASSERT_TRUE(wait_for(session, [&](const auto&) { return fs::exists(folder_ / "jaw.ply"); }));
  EXPECT_FALSE(fs::exists(folder_ / "jaw-margin.obj"));
}

TEST_F(SessionReview, AMarginIsExportedBesideItsModel) {
  Session session(options_);
  draw_and_keep(session);
  const ui::ExportTarget target = {folder_.path().string(),         "jaw", {".ply"},
                                   reconstruct::MeshDensity::kFull, false, false};
  session.carry_out(ui::Export{target, {}});
  EXPECT_TRUE(
      wait_for(session, [&](const auto&) { return fs::exists(folder_ / "jaw-margin.obj"); }));
}

TEST_F(SessionReview, NumbersAreThoseOfTheReviewOfAFile) {
  Session session(options_);
  ASSERT_TRUE(open(session));
  const std::array<Vec3, 3> points_mm = {jaw_.margin_mm.front(), jaw_.tooth_mm,
                                         jaw_.margin_mm[jaw_.margin_mm.size() / 2]};
  const std::vector<Vec3> ends_mm = {points_mm[0], points_mm[2]};
  session.carry_out(ui::AddMeasurement{{0, ends_mm[0], ends_mm[1], {}}});
  session.carry_out(ui::MeasureAngle{points_mm});
  const review::Plane plane = {jaw_.tooth_mm, (points_mm[2] - points_mm[0]).normalized()};
  session.carry_out(ui::CutSection{plane, ends_mm});
  session.carry_out(ui::FindUndercut{{Vec3::UnitZ(), jaw_.tooth_mm, 7.0}});
  ASSERT_TRUE(wait_for(session, [](const ui::AppView& view) {
    return view.review.undercut != nullptr && view.review.section != nullptr &&
           !view.review.angles_rad.empty() && !view.review.distances_mm.empty();
  }));
  const auto shown = session.view().review;

  const fs::path file = folder_ / "jaw.glb";
  ASSERT_TRUE(io::write_model(file, {jaw_.mesh, {}, {}}, jaw_.mesh));
  const TriangleMesh mesh = review::made_ready(io::read_model(file)->mesh);
  const MeshDistance distance(mesh);
  const auto same = [](const review::Measured& window, const review::Measured& in_file) {
    EXPECT_NEAR(window.value, in_file.value, 1e-6);
    EXPECT_NEAR(window.uncertainty, in_file.uncertainty, 1e-6);
  };
  same(shown.distances_mm.front(), review::reviewed_number(mesh, distance, ends_mm).measured);
  same(shown.angles_rad.front().measured,
       review::reviewed_number(mesh, distance, points_mm).measured);
  const auto section = review::reviewed_section(mesh, plane, ends_mm);
  ASSERT_TRUE(section);
  ASSERT_TRUE(section->along_mm);
  same(*shown.section->along_mm, *section->along_mm);
  const auto undercut =
      review::reviewed_undercut(mesh, {Vec3::UnitZ(), jaw_.tooth_mm, 7.0}, Workers());
  ASSERT_TRUE(undercut);
  same(shown.undercut->reviewed.undercut.area_mm2, undercut->undercut.area_mm2);
}

}  // namespace
}  // namespace flytri::session
