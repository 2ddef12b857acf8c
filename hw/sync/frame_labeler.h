/// @file  Determines which light lit each frame, from switch times and images; learns the latency.
///
///     stamp ─▶ frame clock ─┐
///     switch times ─────────┼─▶ prediction by time  ─┐
///                 latency ──┘                        ├─▶ label, straddled or unknown
///     image ─▶ evidence ─────────────────────────────┘
///                 └─▶ latency, faults of the lights
///
/// A frame gets a label only if the prediction is certain for every latency that is still likely,
/// and the image does not contradict it. An image without visible light contradicts nothing.
#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "hw/sync/frame_clock.h"
#include "hw/sync/image_light.h"
#include "hw/sync/latency_filter.h"
#include "hw/sync/light_evidence.h"
#include "hw/sync/light_history.h"
#include "hw/sync/light_plan.h"
#include "hw/sync/light_watch.h"

namespace flytri::sync {

struct LabelerOptions {
  FrameClockOptions clock;
  LatencyOptions latency;  ///< its frame period is replaced by that of `clock`
  ImageLightOptions image;
  EvidenceOptions evidence;
  WatchOptions watch;
  /// 0.5..1. Probability from which the prediction counts as certain.
  double certainty = 0.98;
  /// 0.5..1. If less than this share of the line light has the direction of the pattern, the frame
  /// shows a mixture.
  double pure_share = 0.8;
  /// pure_share..1. From this share, the image confirms a prediction that is nearly certain.
  double clear_share = 0.9;
  [[nodiscard]] Result<void> validate() const;
};

/// kStraddled: the exposure saw two lights. kUnknown: the latency is not known well enough, or
/// image and prediction disagree.
enum class LabelOutcome { kLabeled, kStraddled, kUnknown };

struct FrameLabel {
  LabelOutcome outcome = LabelOutcome::kUnknown;
  device::Light light = device::Light::kDark;  ///< only if labeled
  double time_s = 0.0;  ///< middle of the exposure, on the clock of the switch times
  /// False: time_s may be off by a frame.
  bool has_time = true;
  LightEvidence evidence;
};

/// Number of frames by outcome.
struct LabelCounts {
  std::int64_t labeled = 0;
  std::int64_t straddled = 0;
  std::int64_t unknown = 0;
};

/// Deterministic: the same calls give the same labels.
class FrameLabeler {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<FrameLabeler> create(const LabelerOptions& options);

  void posted(std::int64_t request, double not_before_s) { history_.posted(request, not_before_s); }
  void switched(const device::LightSwitching& done);

  /// Labels a frame. Pass frames in order of their stamps, and report all light switching before a
  /// frame's arrival first.
  [[nodiscard]] FrameLabel label(const cv::Mat& image, double stamp_s);

  /// A frame without a label, because the lights are off on purpose: only the frame clock learns
  /// from it. Dark images would make the latency less and less certain.
  void pass(double stamp_s) { (void)clock_.add(stamp_s); }

  /// The camera was unplugged or restarted: its exposure times are learned again. The latency is
  /// kept, and adapts if it has changed.
  void camera_returned();

  /// Input of LightPlan.
  [[nodiscard]] CameraTiming timing() const {
    return {clock_, latency_, is_learned_, history_.call_s()};
  }
  [[nodiscard]] const LatencyEstimate& latency() const { return latency_; }
  [[nodiscard]] bool is_learned() const { return is_learned_; }
  [[nodiscard]] LightFault fault() const;
  [[nodiscard]] const LabelCounts& counts() const { return counts_; }

 private:
  explicit FrameLabeler(const LabelerOptions& options);
  [[nodiscard]] std::optional<device::Light> expected(const LightPrediction& prediction,
                                                      const LightEvidence& evidence) const;
  [[nodiscard]] LabelOutcome judge(device::Light light, const LightEvidence& evidence) const;
  void set_time(FrameLabel& label, double steady_s, const LightPrediction& prediction) const;
  void count(LabelOutcome outcome);

  LabelerOptions options_;
  LightHistory history_;
  FrameClock clock_;
  EvidenceReader reader_;
  LatencyFilter filter_;
  LightWatch watch_;
  LatencyEstimate latency_;
  bool is_learned_ = false;
  LabelCounts counts_;
  std::int64_t switchings_ = 0;                        // number of changes between the patterns
  device::Light last_pattern_ = device::Light::kDark;  // latest pattern that was switched on
};

}  // namespace flytri::sync
