/// @file  The real window on a finished jaw with a prepared tooth: measured by real clicks, and
///        compared with what the library measures at the same places.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/review/margin.h"
#include "core/review/reviewed.h"
#include "tests/support/fake_jaw.h"
#include "tests/ui/real_window.h"
#include "ui/scene/orbit_camera.h"

namespace flytri {
namespace {

using testing::FakeJaw;
using testing::Names;
using testing::RealWindow;

double number_of(const nlohmann::json& json) { return json.get<double>(); }

Vec3 point_of(const nlohmann::json& json) {
  return {number_of(json[0]), number_of(json[1]), number_of(json[2])};
}

std::vector<Vec3> points_of(const nlohmann::json& json) {
  std::vector<Vec3> points_mm;
  for (const auto& point : json) points_mm.push_back(point_of(point));
  return points_mm;
}

class ReviewWindow : public RealWindow {
 protected:
  static void SetUpTestSuite() {
    RealWindow::SetUpTestSuite();
    jaw_ = std::make_unique<FakeJaw>();
    mesh_ = review::made_ready(jaw_->prepared_jaw().mesh);
  }
  static void TearDownTestSuite() {
    RealWindow::TearDownTestSuite();
    jaw_.reset();
  }
  void SetUp() override {
    RealWindow::SetUp();
    if (IsSkipped()) return;
    show("prepared");
    window().key("o");
    window().ask("wait 60");
    // Nearer to the prepared tooth.
    const auto [x_px, y_px] = place_of(jaw_->prepared_jaw().tooth_mm);
    window().point(x_px, y_px);
    window().wheel(10);
    window().ask("wait 60");
    (void)window().commands();
  }

  static nlohmann::json measured() { return window().state()["review"]; }
  /// Where the window shows a point of the scene, px.
  static std::pair<double, double> place_of(const Vec3& p_mm) {
    const nlohmann::json camera = window().state()["camera"];
    const auto& q = camera["q_wxyz"];
    ui::OrbitCamera seen;
    seen.set_pose(
        {point_of(camera["target_mm"]),
         Eigen::Quaterniond(number_of(q[0]), number_of(q[1]), number_of(q[2]), number_of(q[3])),
         number_of(camera["height_mm"])});
    const auto scene = window().where("scene").value();
    const Vec3 p_eye = seen.T_world_eye().inverse() * p_mm;
    const Eigen::Matrix4d P =
        seen.projection(scene.width_px / scene.height_px, -0.5 * p_eye.z(), -2.0 * p_eye.z());
    const Eigen::Vector4d clip = P * p_eye.homogeneous();
    return {scene.x_px + (0.5 + 0.5 * clip.x() / clip.w()) * scene.width_px,
            scene.y_px + (0.5 - 0.5 * clip.y() / clip.w()) * scene.height_px};
  }
  static void click_on(const Vec3& p_mm) {
    const auto [x_px, y_px] = place_of(p_mm);
    window().click_at(x_px, y_px);
  }
  /// A place of the true margin, by its share of the line.
  static Vec3 margin_at(double share) {
    const auto& line_mm = jaw_->prepared_jaw().margin_mm;
    return line_mm[static_cast<std::size_t>(share * static_cast<double>(line_mm.size()))];
  }
  static void expect_same(const nlohmann::json& shown, const review::Measured& measured) {
    EXPECT_DOUBLE_EQ(number_of(shown["value"]), measured.value);
    EXPECT_DOUBLE_EQ(number_of(shown["uncertainty"]), measured.uncertainty);
    EXPECT_GT(measured.uncertainty, 0.0);
  }

  static inline std::unique_ptr<FakeJaw> jaw_;
  static inline TriangleMesh mesh_;
};

TEST_F(ReviewWindow, TheToolOpensThePanelOnAFinishedModelOnly) {
  EXPECT_EQ(after_key("m"), Names{"BeginReview"});
  EXPECT_EQ(measured()["mode"], "distance");
  window().click("section");
  EXPECT_EQ(measured()["mode"], "section");
  show("paused");
  EXPECT_EQ(measured()["mode"], "none");
  EXPECT_FALSE(window().state()["actions"]["margin"]["enabled"]);
}

TEST_F(ReviewWindow, TwoClicksMeasureADistance) {
  window().key("m");
  click_on(margin_at(0.0));
  click_on(margin_at(0.5));
  const nlohmann::json distance = measured()["distances"].back();
  const MeshDistance surface(mesh_);
  expect_same(distance,
              review::reviewed_number(mesh_, surface, points_of(distance["points_mm"])).measured);
  EXPECT_NEAR(number_of(distance["value"]), (margin_at(0.0) - margin_at(0.5)).norm(), 0.5);
}

TEST_F(ReviewWindow, ThreeClicksMeasureAnAngle) {
  window().key("7");
  click_on(margin_at(0.0));
  click_on(margin_at(0.25));
  click_on(jaw_->prepared_jaw().tooth_mm);
  EXPECT_TRUE(measured()["angle_clicks_mm"].empty()) << "the next angle begins anew";
  const nlohmann::json angle = measured()["angles"].back();
  const MeshDistance surface(mesh_);
  const review::Measured expected =
      review::reviewed_number(mesh_, surface, points_of(angle["points_mm"])).measured;
  EXPECT_NEAR(number_of(angle["value"]), expected.value, 1e-6);
  EXPECT_NEAR(number_of(angle["uncertainty"]), expected.uncertainty, 1e-6);
}

TEST_F(ReviewWindow, AClickCutsASectionThatIsMeasuredInItsPicture) {
  window().key("8");
  click_on(jaw_->prepared_jaw().tooth_mm);
  nlohmann::json section = measured()["section"];
  EXPECT_GT(section["outlines"], 0);
  const Vec3 first_mm = point_of(section["point_mm"]);
  // Dragging moves it, and keeps its direction.
  const auto [x_px, y_px] = place_of(jaw_->prepared_jaw().tooth_mm);
  window().drag_at(x_px, y_px, 60.0, 0.0);
  section = measured()["section"];
  EXPECT_GT((point_of(section["point_mm"]) - first_mm).norm(), 0.5);

  const auto plot = window().where("section_plot").value();
  const double middle_px = plot.x_px + plot.width_px / 2.0;
  window().click_at(middle_px - 40.0, plot.y_px + plot.height_px / 2.0);
  window().click_at(middle_px + 40.0, plot.y_px + plot.height_px / 2.0);
  section = measured()["section"];
  const review::ReviewedSection expected =
      review::reviewed_section(mesh_, {point_of(section["point_mm"]), point_of(section["normal"])},
                               points_of(section["clicked_mm"]))
          .value();
  EXPECT_EQ(section["outlines"], expected.outlines.size());
  expect_same(section["straight"],
              review::distance_mm(expected.places[0].point, expected.places[1].point));
  if (expected.along_mm) expect_same(section["along"], *expected.along_mm);
  window().key("z");
  EXPECT_EQ(measured()["section"]["clicked_mm"].size(), 1U);
}

TEST_F(ReviewWindow, AClickFindsTheUndercutAndColorsTheModel) {
  window().key("9");
  click_on(jaw_->prepared_jaw().tooth_mm);
  nlohmann::json undercut = measured()["undercut"];
  EXPECT_TRUE(undercut["shown"]);
  const Vec3 around_mm = point_of(undercut["around_mm"]);
  review::ReviewedUndercut expected =
      review::reviewed_undercut(mesh_, {std::nullopt, around_mm, 7.0}, Workers()).value();
  expect_same(undercut, expected.undercut.area_mm2);

  // From where one looks.
  EXPECT_EQ(after_click("axis_as_seen"), Names{"FindUndercut"});
  undercut = measured()["undercut"];
  const Vec3 axis = point_of(undercut["axis"]);
  expected = review::reviewed_undercut(mesh_, {axis, around_mm, 7.0}, Workers()).value();
  EXPECT_NEAR(number_of(undercut["value"]), expected.undercut.area_mm2.value, 1e-9);
  // Other colors are at hand.
  window().key("4");
  EXPECT_FALSE(measured()["undercut"]["shown"]);
  window().key("9");
  EXPECT_TRUE(measured()["undercut"]["shown"]);
}

TEST_F(ReviewWindow, AMarginLineIsDrawnByClicksAndKept) {
  window().key("0");
  for (const double share : {0.0, 0.2, 0.4, 0.6}) click_on(margin_at(share));
  click_on(margin_at(0.7));
  window().key("z");
  EXPECT_EQ(measured()["margin_clicks_mm"].size(), 4U);
  click_on(margin_at(0.8));
  const nlohmann::json state = measured();
  ASSERT_TRUE(state.contains("drawn")) << state["failures"];
  const review::Margin expected =
      review::find_margin(mesh_, points_of(state["margin_clicks_mm"]), {}, Workers()).value();
  expect_same(state["drawn"], review::length_mm(expected.line));
  EXPECT_EQ(after_key("Return"), Names{"KeepMargin"});
  EXPECT_EQ(measured()["margins"].size(), 1U);
  EXPECT_TRUE(measured()["margin_clicks_mm"].empty());
  EXPECT_EQ(after_click("remove_margin_1"), Names{"RemoveMargin"});
}

}  // namespace
}  // namespace flytri
