/// @file  Shows progress and time left on the terminal, and cancels the job at Ctrl-C.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "core/base/progress.h"

namespace flytri::cli {

/// While it lives, one thread redraws the bar of `progress` on standard error a few times a second
/// and cancels `progress` when the process receives SIGINT, SIGTERM or SIGHUP. A second signal
/// ends the process at once. If standard error is not a terminal, each stage is one line.
class ProgressBar {
 public:
  explicit ProgressBar(Progress progress);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  void run();
  void show(const Progress::Snapshot& snapshot);
  void start_stage(const std::string& stage);

  Progress progress_;
  bool is_terminal_;
  std::string stage_;
  double stage_start_s_ = 0.0;
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

}  // namespace flytri::cli
