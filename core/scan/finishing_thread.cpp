#include "core/scan/finishing_thread.h"

#include <utility>

#include "core/base/free_memory.h"

namespace flytri::scan {
namespace {

/// Registers what could not be registered during the scan, then lists all registered views.
reconstruct::ScannedViews collect(FinishingInput& input, const Progress& progress) {
  reconstruct::ScannedViews scanned;
  progress.begin_stage(reconstruct::kRecovering);
  for (const tracking::RegisteredView& view :
       input.registrar->finish(tracking::Registrar::World::kUnchanged, progress)) {
    if (view.fate == tracking::ViewFate::kRejected || view.view->profiles.empty()) continue;
    scanned.views.push_back({view.view, view.T_world_sensor});
  }
  scanned.texture_frames = std::move(input.texture_frames);
  scanned.edits = input.edits;
  scanned.calibration = input.calibration.get();
  return scanned;
}

}  // namespace

void FinishingThread::announce_run() {
  const std::lock_guard lock(mutex_);
  progress_ = Progress();
  step_.clear();
}

Progress FinishingThread::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

void FinishingThread::run(FinishingInput input, Done done) {
  // A std::function must be copyable, and the input is not.
  auto shared = std::make_shared<FinishingInput>(std::move(input));
  thread_.post([this, shared = std::move(shared), done = std::move(done)] {
    const Progress progress = this->progress();
    StageClock clock(now_s_);
    Result<reconstruct::FinishedScan> finished =
        reconstruct::finish_scan(collect(*shared, progress), options_, Workers(), progress, clock);
    release_free_memory();
    done({std::move(shared->registrar), std::move(finished)});
  });
}

FinishingState FinishingThread::state() {
  constexpr double kMinFraction = 0.05;  // before that, the estimate would jump
  const std::lock_guard lock(mutex_);
  const Progress::Snapshot step = progress_.snapshot();
  if (step.stage != step_) {
    step_ = step.stage;
    step_since_s_ = now_s_();
  }
  const double spent_s = now_s_() - step_since_s_;
  const double remaining_s =
      step.fraction > kMinFraction ? spent_s * (1.0 - step.fraction) / step.fraction : -1.0;
  return {step, remaining_s};
}

void FinishingThread::stop() {
  cancel();
  thread_.stop();
}

}  // namespace flytri::scan
