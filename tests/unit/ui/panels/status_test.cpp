#include "ui/panels/status.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

AppView scanning(scan::ScanPhase phase) {
  AppView view;
  auto scan = std::make_shared<scan::ScanSnapshot>();
  scan->phase = phase;
  view.scan = scan;
  view.is_scanning = true;
  return view;
}

TEST(Status, SaysThatTheScanIsNotSavedUntilItIs) {
  AppView view = scanning(scan::ScanPhase::kMeasurement);
  EXPECT_EQ(status_of(view).text, "Scanning");
  view.file.failure = "a.flytri: no space left";
  EXPECT_EQ(status_of(view).text, "Not saved");
  EXPECT_EQ(status_of(view).hint, "a.flytri: no space left");
  EXPECT_EQ(status_of(view).color, kBad);
  view.file.failure.clear();
  EXPECT_EQ(status_of(view).text, "Scanning");
}

TEST(Status, SaysThatTheCaseIsDamagedOrCannotBeRead) {
  AppView view;
  view.is_scanning = true;
  EXPECT_EQ(status_of(view).text, "Starting");
  view.load_failure = "a.flytri: cannot be read";
  EXPECT_EQ(status_of(view).text, "Not opened");
  EXPECT_EQ(status_of(view).hint, "a.flytri: cannot be read");
  view.file.damaged.emplace();
  EXPECT_EQ(status_of(view).text, "Case damaged");
  EXPECT_EQ(status_of(view).color, kBad);
}

TEST(Status, WarnsWhereTheSurfaceIsFlat) {
  AppView view = scanning(scan::ScanPhase::kMeasurement);
  scan::ScanSnapshot scan = *view.scan;
  scan.surface_hold.is_weak = true;
  view.scan = std::make_shared<const scan::ScanSnapshot>(scan);
  EXPECT_EQ(status_of(view).text, "Flat here");
  EXPECT_EQ(status_of(view).color, kCaution);
  EXPECT_NE(status_of(view).hint, "");
}

TEST(Status, ALostScanIsSaidFirst) {
  AppView view = scanning(scan::ScanPhase::kContinuation);
  view.file.failure = "no space left";
  EXPECT_EQ(status_of(view).text, "Tracking lost");
}

TEST(Status, SaysHowManyDevicesFail) {
  AppView view;
  view.source.is_lost = true;
  view.source.message = "the camera is missing";
  EXPECT_EQ(status_of(view).hint, "the camera is missing");
  view.devices.emplace().problems = {"the camera is missing", "the lights are missing"};
  EXPECT_EQ(status_of(view).hint, "2 problems with its devices: press R to see them");
}

TEST(Status, AReadOnlyCaseDoesNotAskToScan) {
  AppView view;
  EXPECT_EQ(status_of(view).text, "Ready");
  view.file.is_read_only = true;
  EXPECT_EQ(status_of(view).text, "Read-only");
  EXPECT_EQ(status_of(view).hint, "Can be viewed and exported, but not changed");
}

TEST(Status, AScanOfACaseIsPausedBeforeItsSurfaceIsThere) {
  AppView view;
  auto scan = std::make_shared<scan::ScanSnapshot>();
  scan->restored_views = 10;
  view.scan = scan;
  EXPECT_EQ(status_of(view).text, "Paused");
}

TEST(Status, SaysThatACaseIsBeingRead) {
  AppView view;
  view.is_loading = true;
  EXPECT_EQ(status_of(view).text, "Opening");
}

TEST(Status, ARecordingThatEndedIsNeitherScanningNorLost) {
  AppView view;
  view.is_scanning = true;
  auto scan = std::make_shared<scan::ScanSnapshot>();
  for (const auto phase : {scan::ScanPhase::kMeasurement, scan::ScanPhase::kContinuation}) {
    scan->phase = phase;
    view.scan = scan;
    view.source.has_ended = false;
    EXPECT_NE(status_of(view).text, "Recording ended");
    view.source.has_ended = true;
    EXPECT_EQ(status_of(view).text, "Recording ended");
  }
}

}  // namespace
}  // namespace flytri::ui
