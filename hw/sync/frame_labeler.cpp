#include "hw/sync/frame_labeler.h"

#include <algorithm>
#include <numeric>

#include "core/base/check_options.h"

namespace flytri::sync {
namespace {

// Probability from which the user is told that patterns are swapped, or images do not follow the
// lights.
constexpr double kWorthTelling = 0.999;
// Probability from which a light may have lit a frame at all.
constexpr double kPossible = 1e-3;

bool is_pattern(device::Light light) {
  return light == device::Light::kVertical || light == device::Light::kHorizontal;
}

/// Share of the line light that has the direction of the pattern.
double share_along(device::Light pattern, const LightEvidence& evidence) {
  return pattern == device::Light::kVertical ? evidence.column_share : 1.0 - evidence.column_share;
}

}  // namespace

Result<void> LabelerOptions::validate() const {
  return OptionCheck("LabelerOptions")
      .nested(clock)
      .nested(latency)
      .nested(image)
      .nested(evidence)
      .nested(watch)
      .in_range("certainty", certainty, 0.5, 1.0)
      .in_range("pure_share", pure_share, 0.5, 1.0)
      .must("clear_share", clear_share, clear_share >= pure_share && clear_share <= 1.0,
            "from pure_share to 1")
      .result();
}

Result<FrameLabeler> FrameLabeler::create(const LabelerOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  LabelerOptions complete = options;
  complete.latency.frame_period_s = options.clock.period_s;
  return FrameLabeler(complete);
}

FrameLabeler::FrameLabeler(const LabelerOptions& options)
    : options_(options),
      clock_(options.clock),
      reader_(options.evidence),
      filter_(options.latency),
      watch_(options.watch),
      latency_(filter_.estimate()) {}

void FrameLabeler::switched(const device::LightSwitching& done) {
  history_.switched(done);
  if (!done.accepted || !is_pattern(done.light)) return;
  if (done.light != last_pattern_) ++switchings_;
  last_pattern_ = done.light;
}

void FrameLabeler::camera_returned() { clock_ = FrameClock(options_.clock); }

// The light that the clock is certain of; or nearly certain, and the image shows only that light.
std::optional<device::Light> FrameLabeler::expected(const LightPrediction& prediction,
                                                    const LightEvidence& evidence) const {
  for (const device::Light light : {device::Light::kDark, device::Light::kVertical,
                                    device::Light::kHorizontal, device::Light::kFlash}) {
    if (prediction.alone[at(light)] >= options_.certainty) return light;
    const bool is_clear = is_pattern(light) ? evidence.has_lines && share_along(light, evidence) >=
                                                                        options_.clear_share
                                            : light == device::Light::kFlash && evidence.is_flash;
    if (is_clear && prediction.nearly_alone[at(light)] >= options_.certainty) return light;
  }
  return std::nullopt;
}

LabelOutcome FrameLabeler::judge(device::Light light, const LightEvidence& evidence) const {
  const auto labeled_if = [](bool agrees) {
    return agrees ? LabelOutcome::kLabeled : LabelOutcome::kUnknown;
  };
  if (evidence.is_flash) return labeled_if(light == device::Light::kFlash);
  if (!evidence.has_lines) return LabelOutcome::kLabeled;
  if (!is_pattern(light)) return LabelOutcome::kUnknown;
  const double share = share_along(light, evidence);
  // With little light, a mixture cannot be recognized, only the other pattern.
  const bool is_little = evidence.line_places < options_.latency.few_line_places;
  if (share >= (is_little ? 0.5 : options_.pure_share)) return LabelOutcome::kLabeled;
  return share > 1.0 - options_.pure_share ? LabelOutcome::kStraddled : LabelOutcome::kUnknown;
}

FrameLabel FrameLabeler::label(const cv::Mat& image, double stamp_s) {
  FrameLabel label;
  label.evidence = reader_.read(measure_image_light(image, options_.image));
  const double steady_s = clock_.add(stamp_s);
  const LightPrediction prediction = filter_.predict(history_, steady_s);
  const std::optional<device::Light> light = expected(prediction, label.evidence);
  if (light) {
    label.light = *light;
    label.outcome = judge(*light, label.evidence);
  } else if (is_learned_) {
    label.outcome = LabelOutcome::kStraddled;
  }
  filter_.learn(history_, steady_s, label.evidence);
  latency_ = filter_.estimate();
  is_learned_ = filter_.is_learned();
  set_time(label, steady_s, prediction);
  watch_.add({light, label.evidence, switchings_});
  count(label.outcome);
  return label;
}

// The brightest image of a flash shows it alone, so that the flash tells its time before the
// latency is known: a camera that sees no lines learns it from flashes only.
void FrameLabeler::set_time(FrameLabel& label, double steady_s,
                            const LightPrediction& prediction) const {
  constexpr auto kFlash = at(device::Light::kFlash);
  const bool has_flash = label.evidence.is_flash && prediction.alone[kFlash] > kPossible;
  const double latency_s = has_flash ? prediction.latency_s[kFlash] : latency_.latency_s;
  const double sigma_s = has_flash ? prediction.latency_sigma_s[kFlash] : latency_.latency_sigma_s;
  label.time_s = steady_s - latency_s;
  label.has_time = sigma_s < 0.25 * clock_.period_s();
}

void FrameLabeler::count(LabelOutcome outcome) {
  switch (outcome) {
    case LabelOutcome::kLabeled:
      ++counts_.labeled;
      return;
    case LabelOutcome::kStraddled:
      ++counts_.straddled;
      return;
    case LabelOutcome::kUnknown:
      ++counts_.unknown;
  }
}

LightFault FrameLabeler::fault() const {
  return watch_.fault(is_learned_ && latency_.swapped > kWorthTelling,
                      latency_.unexplained > kWorthTelling);
}

}  // namespace flytri::sync
