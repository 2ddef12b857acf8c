/// @file  A thread beside the window that carries out one calibration, or one check.
#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "app/session/calibration_work.h"
#include "core/base/task_thread.h"

namespace flytri::session {

/// What a run is made for.
struct CalibrationJob {
  /// Called by the run's thread, as are those below: devices take their time.
  std::function<Result<std::shared_ptr<shots::ShotSource>>()> open_source;
  std::function<Result<std::unique_ptr<CalibrationWork>>(std::shared_ptr<shots::ShotSource>)>
      begin_work;
  ui::CalibrationTask task = ui::CalibrationTask::kCalibrate;
  std::filesystem::path folder;  ///< of a calibration
};

/// Goes to work at once. Destroyed, it stops what it is doing; then the lights are dark and the
/// devices free. What does not suit the moment is not done.
class CalibrationRun {
 public:
  explicit CalibrationRun(CalibrationJob job);
  ~CalibrationRun();
  CalibrationRun(const CalibrationRun&) = delete;
  CalibrationRun& operator=(const CalibrationRun&) = delete;

  /// Takes the images of the place that is wanted.
  void take();
  /// The place is wanted again.
  void retake(std::size_t place);

  [[nodiscard]] ui::RunningCalibration state() const;

 private:
  // All by the run's thread.
  void open();
  void look();
  void take_images();
  void reopen(std::size_t place);
  void conclude();
  void go_on();  ///< to the next place, or to the result
  void fail(const Error& error);
  void change(const std::function<void(ui::RunningCalibration&)>& change);

  const CalibrationJob job_;
  const Progress progress_;
  std::shared_ptr<shots::ShotSource> source_;
  std::unique_ptr<CalibrationWork> work_;

  mutable std::mutex mutex_;
  ui::RunningCalibration state_;
  /// Nothing is posted twice, so that the thread's queue stays short.
  bool is_asked_ = false;

  TaskThread thread_;  // ends first: its tasks use all of the above
};

}  // namespace flytri::session
