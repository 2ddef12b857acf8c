#include "ui/state/review_look.h"

#include <gtest/gtest.h>

#include <limits>

namespace flytri::ui {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

AppView finished_view() {
  scan::ScanSnapshot scan;
  scan.phase = scan::ScanPhase::kFinished;
  scan.result = std::make_shared<const reconstruct::FinishedScan>();
  AppView view;
  view.scan = std::make_shared<const scan::ScanSnapshot>(std::move(scan));
  return view;
}

TEST(ReviewLook, NumbersHaveTheirUncertainty) {
  EXPECT_EQ(measured_mm_text({1.23456, 0.0124}), "1.235 ± 0.012 mm");
  EXPECT_EQ(measured_mm_text({1.23456, kUnknown}), "1.235 ± ? mm");
  EXPECT_EQ(measured_angle_text({1.0, 0.01}), "57.30 ± 0.57 °");
}

TEST(ReviewLook, TheChewingSurfacesAreUpInASection) {
  JawAxes jaw;
  jaw.occlusal = -Vec3::UnitZ();
  jaw.buccal = Vec3::UnitX();
  const SectionAxes across = section_axes({Vec3::Zero(), Vec3(0.0, 2.0, 0.1)}, &jaw);
  EXPECT_GT(across.up.dot(jaw.occlusal), 0.99);
  EXPECT_NEAR(across.right.dot(across.up), 0.0, 1e-12);
  // Seen against the normal: right, up and the normal are right-handed.
  EXPECT_GT(across.right.cross(across.up).dot(Vec3::UnitY()), 0.99);
  const SectionAxes along = section_axes({Vec3::Zero(), Vec3::UnitZ()}, &jaw);
  EXPECT_GT(along.up.dot(jaw.buccal), 0.99);
  const SectionAxes unknown = section_axes({Vec3::Zero(), Vec3::UnitZ()}, nullptr);
  EXPECT_NEAR(unknown.up.dot(Vec3::UnitZ()), 0.0, 1e-12);
}

TEST(ReviewLook, ClicksAreTakenBackOneByOne) {
  WindowState state;
  state.review.mode = ReviewMode::kMargin;
  EXPECT_FALSE(take_click_back(state));
  state.review.margin_mm = {Vec3::Zero(), Vec3::UnitX()};
  state.review.angle_mm = {Vec3::Zero()};
  EXPECT_TRUE(take_click_back(state));
  EXPECT_EQ(state.review.margin_mm.size(), 1U);
  EXPECT_EQ(state.review.angle_mm.size(), 1U) << "those of another mode stay";
}

TEST(ReviewLook, AnotherModelForgetsWhatWasClicked) {
  WindowState state;
  const AppView view = finished_view();
  follow_reviewed_model(view, state);
  state.review.mode = ReviewMode::kMargin;
  state.review.margin_mm = {Vec3::Zero()};
  follow_reviewed_model(view, state);
  EXPECT_EQ(state.review.margin_mm.size(), 1U);
  follow_reviewed_model(finished_view(), state);
  EXPECT_TRUE(state.review.margin_mm.empty());
  EXPECT_EQ(state.review.mode, ReviewMode::kMargin);
}

TEST(ReviewLook, AMarginLineIsKeptOnceItIsThatOfAllClicks) {
  AppView view = finished_view();
  WindowState state;
  state.tool = Tool::kMeasure;
  state.review.mode = ReviewMode::kMargin;
  state.review.margin_mm = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  EXPECT_FALSE(can_keep_margin(view, state));
  DrawnMargin drawn;
  drawn.clicks_mm = {Vec3::Zero(), Vec3::UnitX()};
  view.review.drawn = std::make_shared<const DrawnMargin>(drawn);
  EXPECT_FALSE(can_keep_margin(view, state)) << "the latest click is not in it";
  drawn.clicks_mm = state.review.margin_mm;
  view.review.drawn = std::make_shared<const DrawnMargin>(drawn);
  EXPECT_TRUE(can_keep_margin(view, state));
  view.file.is_read_only = true;
  EXPECT_FALSE(can_keep_margin(view, state));
}

}  // namespace
}  // namespace flytri::ui
