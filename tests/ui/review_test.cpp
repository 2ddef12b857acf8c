/// @file  Measuring on a finished model in the real window, by real clicks and keys.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "tests/ui/real_window.h"

namespace flytri {
namespace {

using testing::Names;
using testing::RealWindow;

/// A jaw with a prepared tooth, seen from above.
class ReviewWindow : public RealWindow {
 protected:
  void SetUp() override {
    RealWindow::SetUp();
    if (IsSkipped()) return;
    show("prepared");
    window().ask("do occlusal");
    window().ask("wait 60");
    window().key("m");
    window().ask("wait 5");
    (void)window().commands();
  }
  static nlohmann::json review() { return window().state()["review"]; }
  /// A place on a tooth or between: a share of the picture.
  static testing::WindowDriver::Place at(double x, double y) {
    const auto scene = window().where("scene").value();
    return {scene.x_px + x * scene.width_px, scene.y_px + y * scene.height_px};
  }
  static Names click(const testing::WindowDriver::Place& place) {
    window().click_at(place.x_px, place.y_px);
    return window().commands();
  }
  static inline const std::array<std::array<double, 2>, 3> kTeeth = {
      {{0.346, 0.589}, {0.698, 0.722}, {0.536, 0.283}}};
  static Names click_tooth(std::size_t i) { return click(at(kTeeth[i][0], kTeeth[i][1])); }
  static double distance_mm(const nlohmann::json& points) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double d = points[0][i].get<double>() - points[1][i].get<double>();
      sum += d * d;
    }
    return std::sqrt(sum);
  }
};

TEST_F(ReviewWindow, TwoClicksGiveADistanceWithItsUncertainty) {
  EXPECT_EQ(review()["mode"], "distance");
  const std::size_t before = review()["distances"].size();
  EXPECT_EQ(click_tooth(0), Names{});
  EXPECT_EQ(click_tooth(1), Names{"AddMeasurement"});
  const auto distances = review()["distances"];
  ASSERT_EQ(distances.size(), before + 1);
  const auto& last = distances.back();
  EXPECT_GT(last["value"], 10.0);
  EXPECT_NEAR(last["value"], distance_mm(last["points_mm"]), 1e-4);
  EXPECT_GT(last["uncertainty"], 0.0);
  EXPECT_LT(last["uncertainty"], 0.5);
}

TEST_F(ReviewWindow, ThreeClicksGiveAnAngle) {
  (void)after_click("measure_angle");
  EXPECT_EQ(review()["mode"], "angle");
  EXPECT_EQ(click_tooth(0), Names{});
  EXPECT_EQ(click_tooth(1), Names{});
  EXPECT_EQ(review()["angle_clicks_mm"].size(), 2U);
  (void)after_key("z");
  EXPECT_EQ(review()["angle_clicks_mm"].size(), 1U) << "Undo takes a click back";
  EXPECT_EQ(click_tooth(1), Names{});
  EXPECT_EQ(click_tooth(2), Names{"MeasureAngle"});
  ASSERT_EQ(review()["angles"].size(), 1U);
  EXPECT_GT(review()["angles"][0]["value"], 0.1);
  EXPECT_LT(review()["angles"][0]["value"], 3.1);
}

TEST_F(ReviewWindow, AClickCutsASection) {
  (void)after_click("section");
  EXPECT_EQ(click_tooth(0), Names{"CutSection"});
  EXPECT_GE(review()["section"]["outlines"], 1);
}

TEST_F(ReviewWindow, AClickFindsTheUndercutAroundIt) {
  (void)after_click("undercut");
  (void)window().commands();
  EXPECT_EQ(click_tooth(0), Names{"FindUndercut"});
  EXPECT_GE(review()["undercut"]["value"], 0.0);
  EXPECT_TRUE(review()["undercut"]["shown"]);
}

TEST_F(ReviewWindow, AMarginThatIsNotThereIsRefusedWithTheReason) {
  (void)after_click("margin");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(click_tooth(i), Names{"DrawMargin"});
  EXPECT_FALSE(review()["failures"][2].get<std::string>().empty());
  EXPECT_EQ(after_key("Return"), Names{}) << "nothing to keep";
  for (std::size_t i = 3; i > 0; --i) {
    EXPECT_EQ(review()["margin_clicks_mm"].size(), i);
    EXPECT_EQ(after_key("z"), Names{"DrawMargin"});
  }
}

TEST_F(ReviewWindow, PuttingTheToolAwayForgetsTheClicksOfAnAngle) {
  (void)after_click("measure_angle");
  EXPECT_EQ(click_tooth(0), Names{});
  (void)after_key("Escape");
  EXPECT_EQ(review()["mode"], "none");
  (void)after_key("m");
  (void)after_click("measure_angle");
  EXPECT_TRUE(review()["angle_clicks_mm"].empty());
}

}  // namespace
}  // namespace flytri
