#include <gtest/gtest.h>

#include "ui/panels/status.h"
#include "ui/panels/toasts.h"
#include "ui/widgets/distance_bar.h"
#include "ui/widgets/meter.h"
#include "ui/widgets/volume_preview.h"

namespace flytri::ui {
namespace {

TEST(DistanceBar, MiddleHalfOfTheVolumeIsGood) {
  EXPECT_EQ(judge_distance(-0.9), DistanceVerdict::kTooNear);
  EXPECT_EQ(judge_distance(-0.4), DistanceVerdict::kFine);
  EXPECT_EQ(judge_distance(0.4), DistanceVerdict::kFine);
  EXPECT_EQ(judge_distance(0.9), DistanceVerdict::kTooFar);
}

TEST(NumberTexts, ClockCountsMinutesAndHours) {
  EXPECT_EQ(clock_text(-1.0), "0:00");
  EXPECT_EQ(clock_text(65.9), "1:05");
  EXPECT_EQ(clock_text(3661.0), "1:01:01");
}

TEST(NumberTexts, SizesAndLengthsHaveSuitableUnits) {
  EXPECT_EQ(size_text(999), "999 B");
  EXPECT_EQ(size_text(12'400), "12 kB");
  EXPECT_EQ(size_text(12'400'000), "12.4 MB");
  EXPECT_EQ(length_text(0.021), "21 \u00b5m");
  EXPECT_EQ(length_text(4.567), "4.57 mm");
}

TEST(NumberTexts, TimeLeftIsRounded) {
  EXPECT_EQ(time_left_text(-1.0, Texts()), "");
  EXPECT_EQ(time_left_text(3.0, Texts()), "a few seconds left");
  EXPECT_EQ(time_left_text(48.0, Texts()), "about 50 s left");
  EXPECT_EQ(time_left_text(125.0, Texts()), "about 3 min left");
}

TEST(VolumePreview, TheWholeVolumeLiesInTheBox) {
  const Rect box = {10.0F, 20.0F, 300.0F, 120.0F};
  for (const Vec3& volume_mm : {Vec3(20, 15, 15), Vec3(200, 150, 100)}) {
    for (int bits = 0; bits < 8; ++bits) {
      const Vec3 corner((bits & 1) - 0.5, ((bits >> 1) & 1) - 0.5, ((bits >> 2) & 1) - 0.5);
      const ImVec2 at = place_in_preview(box, volume_mm, volume_mm.cwiseProduct(corner));
      EXPECT_TRUE(box.inset(-0.01F).contains(at)) << bits;
    }
  }
}

TEST(VolumePreview, DepthGoesToTheUpperRight) {
  const Rect box = {0.0F, 0.0F, 100.0F, 100.0F};
  const Vec3 volume_mm(20, 15, 15);
  const ImVec2 near = place_in_preview(box, volume_mm, Vec3(0, 0, -5));
  const ImVec2 far = place_in_preview(box, volume_mm, Vec3(0, 0, 5));
  EXPECT_GT(far.x, near.x);
  EXPECT_LT(far.y, near.y);
}

Notice notice(std::uint64_t number, Severity severity) { return {number, severity, "text"}; }

TEST(Toasts, EachNoticeShowsOnceForItsTime) {
  AppView view;
  WindowState state;
  view.notices = {notice(1, Severity::kInformation), notice(2, Severity::kError)};
  update_toasts(view, state);
  EXPECT_EQ(state.toasts.size(), 2U);
  view.now_s = toast_duration_s(Severity::kInformation) + 0.1;
  update_toasts(view, state);
  ASSERT_EQ(state.toasts.size(), 1U);
  EXPECT_EQ(state.toasts.front().notice.severity, Severity::kError);
  view.now_s = toast_duration_s(Severity::kError) + 0.1;
  update_toasts(view, state);
  EXPECT_TRUE(state.toasts.empty());
}

TEST(Toasts, OnlyTheLatestFewStay) {
  AppView view;
  WindowState state;
  for (std::uint64_t i = 1; i <= 10; ++i) view.notices.push_back(notice(i, Severity::kWarning));
  update_toasts(view, state);
  ASSERT_EQ(state.toasts.size(), 3U);
  EXPECT_EQ(state.toasts.back().notice.number, 10U);
}

TEST(Status, ALossIsRedAndSaysWhatToDo) {
  AppView view;
  auto scan = std::make_shared<scan::ScanSnapshot>();
  scan->phase = scan::ScanPhase::kContinuation;
  view.scan = scan;
  view.is_scanning = true;
  const Status lost = status_of(view);
  EXPECT_EQ(lost.color, kBad);
  EXPECT_FALSE(lost.hint.empty());
  view.source.is_lost = true;
  view.source.message = "Plug the camera in again";
  EXPECT_EQ(status_of(view).hint, view.source.message);
}

TEST(Status, SaysThatTheSensorStartsUntilThereAreFrames) {
  AppView view;
  EXPECT_EQ(status_of(view).text, "Ready");
  view.is_scanning = true;
  EXPECT_EQ(status_of(view).text, "Starting");
}

}  // namespace
}  // namespace flytri::ui
