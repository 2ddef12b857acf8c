/// @file  The part of GrowingScan that finishes it: when the user asks for it, or ahead of that.
#include <algorithm>
#include <utility>

#include "core/scan/growing_scan.h"

namespace flytri::scan {

FinishingWork GrowingScan::finishing_work() const {
  const auto now = board_.snapshot();
  // Views that showed nothing new have given their points away.
  const auto with_points =
      std::count_if(views_before_finishing_.begin(), views_before_finishing_.end(),
                    [](const AlignedView& view) { return !view.view->profiles.empty(); });
  return {static_cast<std::size_t>(now->counts.rejected_count()),
          static_cast<std::size_t>(with_points), static_cast<std::size_t>(now->counts.textured),
          now->area_mm2};
}

void GrowingScan::finish(double close_holes_mm) {
  if (!accepts(phase_, ScanEvent::kFinish, has_model())) return;
  if (close_holes_mm != ahead_mm_) end_run_ahead();
  // Before the phase changes: who sees it may cancel the run.
  if (ahead_ == nullptr && !run_.valid()) begin_run(close_holes_mm);
  step(ScanEvent::kFinish);
  board_.update([](ScanSnapshot& s) { s.failure.clear(); });
  if (ahead_ != nullptr) take_result(std::exchange(ahead_, nullptr));
}

void GrowingScan::finish_ahead(double close_holes_mm) {
  if (close_holes_mm == ahead_mm_) return;
  if (phase_ != ScanPhase::kFinishing) end_run_ahead();
  ahead_mm_ = close_holes_mm;
  begin_run_ahead();
}

void GrowingScan::begin_run(double close_holes_mm) {
  views_before_finishing_ = registrar_->measured_views();
  finishing_.announce_run(finishing_work());
  auto output = std::make_shared<std::promise<FinishingOutput>>();
  run_ = output->get_future();
  // A std::function must be copyable, and the input is not.
  auto input = std::make_shared<FinishingInput>(FinishingInput{
      std::move(registrar_), {}, edits_.state(), calibration_, close_holes_mm, held_});
  model_.with_textures(
      [this, input, output, number = ++runs_](const std::vector<PlacedTexture>& placed) {
        for (const PlacedTexture& texture : placed) input->texture_frames.push_back(texture.frame);
        finishing_.run(std::move(*input), [this, output, number](FinishingOutput done) {
          output->set_value(std::move(done));
          ask_([this, number] {
            if (number == runs_ && run_.valid()) take_output();
          });
        });
      });
}

/// Does what finish() will ask for, while the sensor rests.
void GrowingScan::begin_run_ahead() {
  const bool is_at_rest =
      phase_ == ScanPhase::kPreview || (phase_ == ScanPhase::kContinuation && is_away_);
  if (!ahead_mm_ || !is_at_rest || !has_model() || ahead_ != nullptr || run_.valid()) return;
  begin_run(*ahead_mm_);
}

/// Called when the scan changes. A run that is not done stops within a fraction of a second; the
/// poses that it found serve.
void GrowingScan::end_run_ahead() {
  ahead_ = nullptr;
  if (!run_.valid()) return;
  finishing_.cancel();
  FinishingOutput output = run_.get();
  take_back(output);
  take_refined(output.aligned, kToleratedCells);
}

void GrowingScan::take_output() {
  FinishingOutput output = run_.get();
  take_back(output);
  const bool is_ahead = phase_ != ScanPhase::kFinishing;
  if (!output.finished) {
    // The user has not asked yet, and learns of it then.
    if (is_ahead) return;
    take_refined(output.aligned, 0.0);
    return take_no_result(output.finished.error());
  }
  take_refined(output.finished->views, 0.0);
  auto result = std::make_shared<const reconstruct::FinishedScan>(std::move(*output.finished));
  if (is_ahead) {
    ahead_ = std::move(result);
  } else {
    take_result(std::move(result));
  }
}

/// Finishing may have joined submaps to the scan.
void GrowingScan::take_back(FinishingOutput& output) {
  registrar_ = std::move(output.registrar);
  views_before_finishing_.clear();
  hand_over_growth(std::nullopt);
  board_.update([&](ScanSnapshot& s) { s.counts = frame_counter_.counts(offered_); });
  refinement_.discard_run();
}

void GrowingScan::take_result(std::shared_ptr<const reconstruct::FinishedScan> result) {
  held_ = result->held;
  journal([result](ScanJournal& journal) { journal.keep_result(*result); });
  step(ScanEvent::kResult, [&](ScanSnapshot& s) { s.result = result; });
  model_.show_holes(result->surface);
}

void GrowingScan::take_no_result(const Error& why) {
  const bool cancelled = why.code == ErrorCode::kCancelled;
  step(ScanEvent::kNoResult, [&](ScanSnapshot& s) { s.failure = cancelled ? "" : why.message; });
  model_.look_for_holes();
}

}  // namespace flytri::scan
