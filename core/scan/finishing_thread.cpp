#include "core/scan/finishing_thread.h"

#include <utility>

#include "core/base/free_memory.h"

namespace flytri::scan {
namespace {

/// Registers what could not be registered during the scan, then lists all registered views.
reconstruct::ScannedViews collect(FinishingInput& input, const Progress& progress) {
  reconstruct::ScannedViews scanned;
  progress.begin_stage(reconstruct::kRecovering);
  input.registrar->set_edits(input.edits);
  for (const tracking::RegisteredView& view :
       input.registrar->finish(tracking::Registrar::World::kUnchanged, progress)) {
    if (view.fate == tracking::ViewFate::kRejected || view.view->profiles.empty()) continue;
    scanned.views.push_back({view.view, view.T_world_sensor});
  }
  scanned.texture_frames = std::move(input.texture_frames);
  scanned.edits = input.edits;
  scanned.calibration = input.calibration.get();
  scanned.held = std::move(input.held);
  return scanned;
}

}  // namespace

void FinishingThread::announce_run(const FinishingWork& work) {
  const std::lock_guard lock(mutex_);
  progress_ = Progress();
  estimate_ = FinishingEstimate(work, now_s_());
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
    reconstruct::ScannedViews scanned = collect(*shared, progress);
    reconstruct::FinishOptions options = options_;
    options.meshing.close_holes_mm = shared->close_holes_mm;
    Result<reconstruct::FinishedScan> finished =
        reconstruct::finish_scan(scanned, options, Workers(), progress, clock);
    scanned.texture_frames.clear();
    release_free_memory();
    done({std::move(shared->registrar), std::move(scanned.views), std::move(finished)});
  });
}

FinishingState FinishingThread::state() {
  const std::lock_guard lock(mutex_);
  return estimate_.at(progress_.snapshot(), now_s_());
}

void FinishingThread::stop() {
  cancel();
  thread_.stop();
}

}  // namespace flytri::scan
