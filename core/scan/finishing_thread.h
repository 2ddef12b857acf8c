/// @file  Makes the result of a scan beside it, one at a time, and tells how far it is.
#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "core/base/task_thread.h"
#include "core/reconstruct/finish_scan.h"
#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

/// Thread-safe.
class FinishingThread {
 public:
  /// What is to be finished, told when the thread comes to it.
  using Collect = std::function<reconstruct::ScannedViews(const Progress&)>;
  /// Gets what came of it, on the thread.
  using Done = std::function<void(Result<reconstruct::FinishedScan>)>;

  FinishingThread(const reconstruct::FinishOptions& options, std::function<double()> now_s)
      : options_(options), now_s_(std::move(now_s)) {}

  /// A cancel() from now on is for the next run.
  void expect_run();
  void run(Collect collect, Done done);
  void cancel() const { progress().cancel(); }
  /// Of the latest run. The time that is left is guessed from what a step took so far.
  [[nodiscard]] FinishingState state();
  [[nodiscard]] std::size_t pending() const { return thread_.pending(); }
  void stop();

 private:
  [[nodiscard]] Progress progress() const;

  const reconstruct::FinishOptions options_;
  const std::function<double()> now_s_;
  mutable std::mutex mutex_;
  Progress progress_;
  std::string step_;  ///< that state() told of last
  double step_since_s_ = 0.0;
  TaskThread thread_;  ///< destroyed first
};

}  // namespace flytri::scan
