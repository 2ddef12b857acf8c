#include "core/scan/finishing_thread.h"

#include <utility>

#include "core/base/free_memory.h"
#include "core/reconstruct/recover_views.h"

namespace flytri::scan {
namespace {

/// Share of recovering for views that a rolling shutter has distorted.
constexpr double kDistortedShare = 0.3;

/// Registers what could not be registered during the scan, then lists all registered views.
reconstruct::ScannedViews collect(FinishingInput& input, const reconstruct::FinishOptions& options,
                                  const Progress& progress) {
  constexpr auto kWorld = tracking::Registrar::World::kUnchanged;
  reconstruct::ScannedViews scanned;
  progress.begin_stage(reconstruct::kRecovering);
  input.registrar->set_edits(input.edits);
  auto settled = input.registrar->finish(kWorld, progress.part(1.0 - kDistortedShare));
  if (input.edits->empty() && input.calibration != nullptr && options.correct_rolling_shutter) {
    auto recovered = reconstruct::recover_views(*input.registrar, settled, *input.calibration,
                                                {options.refinement, kWorld}, Workers(),
                                                progress.part(kDistortedShare));
    // A run that was canceled stops in the next stage.
    if (recovered) settled = *std::move(recovered);
  }
  for (const tracking::RegisteredView& view : settled) {
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
    reconstruct::ScannedViews scanned = collect(*shared, options_, progress);
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
