/// @file  Which light lit a frame: switch times and images go in, labels and the latency come out.
///
///     stamp ─▶ steady beat ─┐
///     switch times ─────────┼─▶ what the clock says ─┐
///                 latency ──┘                        ├─▶ label, straddled or unknown
///     image ─▶ evidence ─────────────────────────────┘
///                 └─▶ latency, faults of the lights
///
/// A frame gets a label only if the clock is sure, for every latency that is still likely, and the
/// image does not say otherwise; an image that shows nothing says nothing.
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
  LatencyOptions latency;  ///< its frame period is that of the clock
  ImageLightOptions image;
  EvidenceOptions evidence;
  WatchOptions watch;
  /// 0.5..1. Probability from which on the clock is sure.
  double certainty = 0.98;
  /// 0.5..1. Share of the lines' light that runs along the pattern, below which it is a mixture.
  double pure_share = 0.8;
  /// pure_share..1. From this share on, the image confirms a clock that is nearly sure.
  double clear_share = 0.9;
  [[nodiscard]] Result<void> validate() const;
};

/// kStraddled: two lights mix in it. kUnknown: the latency is not known well enough, or image and
/// clock disagree.
enum class LabelOutcome { kLabeled, kStraddled, kUnknown };

struct FrameLabel {
  LabelOutcome outcome = LabelOutcome::kUnknown;
  device::Light light = device::Light::kDark;  ///< where it is labeled
  double time_s = 0.0;  ///< middle of the exposure, on the clock of the switch times
  LightEvidence evidence;
};

/// Frames by what became of them.
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

  /// Frames in the order of their stamps, with all that was switched before they arrived.
  [[nodiscard]] FrameLabel label(const cv::Mat& image, double stamp_s);

  /// The camera was away or was set up anew: its beat begins anew. The latency is kept, and learned
  /// again if it is another one now.
  void camera_returned();

  /// What the plan of the lights goes by.
  [[nodiscard]] CameraBeat beat() const {
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
  std::int64_t switchings_ = 0;                        // between patterns
  device::Light last_pattern_ = device::Light::kDark;  // that was switched on
};

}  // namespace flytri::sync
