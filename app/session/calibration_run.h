/// @file  Carries out one calibration, or one check of a calibration, on its own thread.
#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "app/session/calibration_work.h"
#include "core/base/task_thread.h"

namespace flytri::session {

/// What a run does.
struct CalibrationJob {
  /// Both functions are called on the run's thread, because devices can be slow.
  std::function<Result<std::shared_ptr<shots::ShotSource>>()> open_source;
  std::function<Result<std::unique_ptr<CalibrationWork>>(std::shared_ptr<shots::ShotSource>)>
      begin_work;
  ui::CalibrationTask task = ui::CalibrationTask::kCalibrate;
  std::filesystem::path folder;  ///< where a calibration is saved; empty for a check
};

/// Starts at once. The destructor stops it; after that the lights are off and the devices free.
/// A command that does not fit the present step does nothing.
class CalibrationRun {
 public:
  explicit CalibrationRun(CalibrationJob job);
  ~CalibrationRun();
  CalibrationRun(const CalibrationRun&) = delete;
  CalibrationRun& operator=(const CalibrationRun&) = delete;

  /// Takes the images at the place that comes next.
  void take();
  /// Makes this place the next one again.
  void retake(std::size_t place);

  [[nodiscard]] ui::RunningCalibration state() const;

 private:
  // On the run's thread.
  void open();
  void look();
  void take_images();
  void reopen(std::size_t place);
  void conclude();
  void go_on();  ///< goes to the next place, or to the result
  void fail(const Error& error);
  void change(const std::function<void(ui::RunningCalibration&)>& change);

  const CalibrationJob job_;
  const Progress progress_;
  std::shared_ptr<shots::ShotSource> source_;
  std::unique_ptr<CalibrationWork> work_;

  mutable std::mutex mutex_;
  ui::RunningCalibration state_;
  /// A command is waiting. Further ones are ignored, so that the queue stays short.
  bool is_asked_ = false;

  TaskThread thread_;  ///< destroyed first: its tasks use the members above
};

}  // namespace flytri::session
