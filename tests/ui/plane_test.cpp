/// @file  The occlusal plane of a finished jaw in the real window, shown and set by real clicks.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "tests/ui/real_window.h"

namespace flytri {
namespace {

using testing::Names;
using testing::RealWindow;

class PlaneWindow : public RealWindow {
 protected:
  void SetUp() override {
    RealWindow::SetUp();
    if (IsSkipped()) return;
    show("finished");
    window().key("o");
    window().ask("wait 60");
    window().key("shift+o");
    (void)window().commands();
  }
  static nlohmann::json plane() { return window().state()["plane"]; }
  /// Clicks on the teeth, at shares of the picture from above. @return  the commands
  static Names click_at_share(double x, double y) {
    const auto scene = window().where("scene").value();
    last_click_ = {scene.x_px + x * scene.width_px, scene.y_px + y * scene.height_px};
    window().click_at(last_click_.x_px, last_click_.y_px);
    return window().commands();
  }
  /// The first place on a line of the picture, from one share of its height to another, where the
  /// click lands on the jaw.
  static Names click_down(double x, double from, double to) {
    const int before = plane()["points"].get<int>();
    Names commands;
    for (double y = from; y < to; y += 0.03) {
      commands = click_at_share(x, y);
      if (!commands.empty() || plane()["points"].get<int>() != before) break;
    }
    return commands;
  }

  static inline testing::WindowDriver::Place last_click_;
};

TEST_F(PlaneWindow, IsFoundAndShownOnAFinishedJawOnly) {
  EXPECT_EQ(window().state()["tool"], "plane");
  EXPECT_TRUE(plane()["known"]);
  EXPECT_FALSE(plane()["set"]);
  EXPECT_FALSE(window().state()["actions"]["automatic_plane"]["enabled"]);
  window().key("Escape");
  EXPECT_EQ(window().state()["tool"], "none");
  for (const char* state : {"ready", "scanning", "paused", "bite", "jaws"}) {
    show(state);
    EXPECT_FALSE(window().state()["actions"]["occlusal_plane"]["enabled"]) << state;
  }
}

TEST_F(PlaneWindow, ThreeClicksOnTheJawSetIt) {
  // Molars of both sides and an incisor in the occlusal view.
  EXPECT_EQ(click_at_share(0.346, 0.589), Names{});
  EXPECT_EQ(plane()["points"], 1);
  EXPECT_EQ(click_at_share(0.698, 0.722), Names{});
  EXPECT_EQ(plane()["points"], 2);
  window().key("z");
  EXPECT_EQ(plane()["points"], 1) << "Undo takes a point back";
  EXPECT_EQ(click_at_share(0.698, 0.722), Names{});
  EXPECT_EQ(click_at_share(0.536, 0.283), Names{"SetOcclusalPlane"});
  EXPECT_EQ(plane()["points"], 0);
  EXPECT_TRUE(plane()["set"]);
  EXPECT_EQ(after_click("automatic_plane"), Names{"SetOcclusalPlane"});
  EXPECT_FALSE(plane()["set"]);
  EXPECT_EQ(after_key("shift+Delete"), Names{}) << "it is automatic";
}

TEST_F(PlaneWindow, PointsThatAreTooNearAreRefusedWithTheReason) {
  ASSERT_EQ(click_down(0.34, 0.2, 0.9), Names{});
  ASSERT_EQ(plane()["points"], 1);
  // The pointer still is where it has clicked.
  const auto at = last_click_;
  window().click_at(at.x_px + 4.0, at.y_px);
  ASSERT_EQ(plane()["points"], 2);
  window().click_at(at.x_px, at.y_px + 4.0);
  EXPECT_EQ(window().commands(), Names{"SetOcclusalPlane"});
  EXPECT_FALSE(plane()["set"]);
  const auto overlays = window().state()["overlays"].dump();
  EXPECT_NE(overlays.find("toast"), std::string::npos) << overlays;
}

TEST_F(PlaneWindow, TheToolForgetsPointsThatWereNotAllClicked) {
  ASSERT_EQ(click_down(0.34, 0.2, 0.9), Names{});
  ASSERT_EQ(plane()["points"], 1);
  window().key("Escape");
  EXPECT_EQ(plane()["points"], 0);
}

}  // namespace
}  // namespace flytri
