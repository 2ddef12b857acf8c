/// @file  A session on the independent recording, and what its tests wait for.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "app/session/session.h"
#include "app/session/user_folders.h"
#include "core/calibration/fit/calibrate.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {

namespace fs = std::filesystem;

/// Waits until the condition holds; false after a minute.
template <typename Condition>
bool wait_for(Session& session, const Condition& holds) {
  for (const double end_s = session.now_s() + 60.0; session.now_s() < end_s;) {
    if (holds(session.view())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

inline std::int64_t registered(const ui::AppView& view) {
  return view.scan == nullptr ? 0 : view.scan->counts.registered;
}

inline bool warns_of_other_calibration(const ui::AppView& view) {
  return std::any_of(view.notices.begin(), view.notices.end(), [](const ui::Notice& notice) {
    return notice.text.find("another calibration") != std::string::npos;
  });
}

class SessionOnARecording : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto set = io::read_calibration_set(testing::shared_data() / "calibration-intraoral");
    if (set) calibration_ = calibration::calibrate(*set, {}, Workers(), Progress()).value();
  }

  void SetUp() override {
    if (!fs::exists(testing::shared_data())) {
      GTEST_SKIP() << "no recording in " << testing::shared_data().string();
    }
    setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
    setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
    setenv("XDG_STATE_HOME", folder_.path().c_str(), 1);
    options_.unnamed_folder = unnamed_cases_folder();
    ASSERT_TRUE(calibration_);
    ASSERT_TRUE(io::write_calibration(folder_.path() / "calibration.json", *calibration_));
    options_.scan.background = TaskThread::Priority::kNormal;
    // A busy machine skips no frames.
    options_.scan.max_frames_underway = options_.scan.max_views_waiting = 1000;
    options_.source.name = kRecordingSource;
    options_.source.path = testing::shared_data() / "recording-quadrant";
    options_.source.calibration = folder_.path() / "calibration.json";
  }

  TemporaryFolder folder_;
  SessionOptions options_;

 private:
  static inline std::optional<calibration::Calibration> calibration_;
};

}  // namespace flytri::session
