/// @file  Makes the finished model of a scan on its own thread, and reports the progress.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/task_thread.h"
#include "core/reconstruct/finish_scan.h"
#include "core/scan/finishing_estimate.h"
#include "core/tracking/registrar.h"

namespace flytri::scan {

/// What finishing needs. The scan moves it here, so that no other thread can use it meanwhile.
struct FinishingInput {
  std::unique_ptr<tracking::Registrar> registrar;
  std::vector<Frame> texture_frames;
  editing::EditList edits;
  std::shared_ptr<const calibration::Calibration> calibration;
  double close_holes_mm = 0.0;                       ///< as MeshOptions, in place of the options'
  std::shared_ptr<const editing::HeldSurface> held;  ///< as ScannedViews
};

struct FinishingOutput {
  std::unique_ptr<tracking::Registrar> registrar;  ///< the one of the input
  std::vector<AlignedView> aligned;  ///< all registered views, with the best poses found
  Result<reconstruct::FinishedScan> finished;
};

/// Thread-safe. The caller starts the next run only after the last one is done.
class FinishingThread {
 public:
  /// Called on this thread with the output.
  using Done = std::function<void(FinishingOutput)>;

  FinishingThread(const reconstruct::FinishOptions& options, std::function<double()> now_s)
      : options_(options), now_s_(std::move(now_s)) {}

  /// Announces a run. From now on cancel() cancels it, even before run() is called.
  void announce_run(const FinishingWork& work);
  void run(FinishingInput input, Done done);
  void cancel() const { progress().cancel(); }
  /// Progress of the latest run.
  [[nodiscard]] FinishingState state();
  [[nodiscard]] std::size_t pending() const { return thread_.pending(); }
  void stop();

 private:
  [[nodiscard]] Progress progress() const;

  const reconstruct::FinishOptions options_;
  const std::function<double()> now_s_;
  mutable std::mutex mutex_;
  Progress progress_;
  FinishingEstimate estimate_{{}, 0.0};
  TaskThread thread_;  ///< destroyed first
};

}  // namespace flytri::scan
