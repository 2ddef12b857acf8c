#include "core/scan/finishing_estimate.h"

#include <algorithm>

namespace flytri::scan {
namespace {

/// Measured on two cores by `flytri reconstruct`, for a real upper jaw of 1726 views. Only their
/// ratios matter once finishing runs.
constexpr double kPerLostView_s = 0.05, kAlignPerView_s = 0.019, kNormalsPerView_s = 0.006,
                 kSimplifyPerView_s = 0.027, kMeshPerSquareMm_s = 0.002, kTexturePerFrame_s = 0.5;
/// Until as much was planned and done, the plan counts more than the clock.
constexpr double kTrust_s = 1.0;
/// The remaining time is told from this share of the plan on.
constexpr double kToldFrom = 0.03;

}  // namespace

FinishingEstimate::FinishingEstimate(const FinishingWork& work, double now_s)
    : began_s_(now_s), current_since_s_(now_s) {
  const auto views = static_cast<double>(work.views);
  stages_ = {
      {reconstruct::kRecovering, kPerLostView_s * static_cast<double>(work.lost_views)},
      {reconstruct::kAligning, kAlignPerView_s * views},
      {reconstruct::kNormals, kNormalsPerView_s * views},
      {reconstruct::kSimplifying, kSimplifyPerView_s * views},
      {reconstruct::kMeshing, kMeshPerSquareMm_s * work.area_mm2},
      {reconstruct::kTexturing, kTexturePerFrame_s * static_cast<double>(work.texture_frames)}};
}

void FinishingEstimate::enter(const std::string& stage, double now_s) {
  const auto found = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const Stage& known) { return known.name == stage; });
  const auto index = static_cast<std::size_t>(found - stages_.begin());
  if (found == stages_.end() || index <= current_) return;
  stages_[current_].spent_s = now_s - current_since_s_;
  current_ = index;
  current_since_s_ = now_s;
}

FinishingState FinishingEstimate::at(const Progress::Snapshot& step, double now_s) {
  if (step.stage.empty()) return {};
  enter(step.stage, now_s);
  double planned_s = 0.0, done_s = 0.0;
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    planned_s += stages_[i].planned_s;
    if (i < current_) done_s += stages_[i].planned_s;
  }
  const Stage& current = stages_[current_];
  const double later_s = planned_s - done_s - current.planned_s;
  done_s += step.fraction * current.planned_s;
  const double elapsed_s = now_s - began_s_, spent_s = now_s - current_since_s_;
  const double slowness = (elapsed_s + kTrust_s) / (done_s + kTrust_s);
  // The less of a stage is done, the more the plan counts; but it takes at least as long as it has.
  const double stage_s = std::max(slowness * current.planned_s, spent_s);
  const double remaining_s = (1.0 - step.fraction) * stage_s + slowness * later_s;
  const double share = elapsed_s / std::max(elapsed_s + remaining_s, 1e-9);
  fraction_ = std::max(fraction_, std::min(share, 1.0));
  return {step.stage, fraction_, done_s > kToldFrom * planned_s ? remaining_s : -1.0};
}

}  // namespace flytri::scan
