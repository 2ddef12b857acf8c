/// @file  Which light is to shine when: the sequence of the paper, kept in step with the camera.
///
/// Until the latency is known, the patterns alternate after times of random length: a periodic
/// sequence looks the same one period later, and swapped patterns the same half a period later.
/// Once it is known, switches lie in the gaps between exposures, one frame a pattern; where the
/// gaps are too short for that, each pattern stays for two frames, of which the one in the middle
/// is whole.
/// @source  Arold et al., "Sensor Setup" (alternating patterns) and "Texture Acquisition and
/// Mapping"
///          (the acquisition is interrupted about every second for a flash).
#pragma once

#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/base/result.h"
#include "core/imaging/pattern.h"
#include "hw/device/light_switch.h"
#include "hw/sync/frame_clock.h"
#include "hw/sync/latency_filter.h"

namespace flytri::sync {

struct LightPlanOptions {
  bool has_flash = true;  ///< false: a dark slot takes its place, which keeps the sequence uneven
  /// > 0. Time from flash to flash.
  double flash_period_s = 1.0;
  /// 1..10 frames of the measurement camera, so that a whole exposure of the texture camera fits.
  int flash_frames = 2;
  /// 0..0.5 periods. A switch keeps this distance from an exposure; less: two frames a pattern.
  double margin = 0.15;
  std::uint64_t seed = 1;  ///< of the random times
  [[nodiscard]] Result<void> validate() const;
};

/// What the plan needs to know of the camera by now.
struct CameraBeat {
  FrameClock clock;
  LatencyEstimate latency;
  bool is_learned = false;
  /// How long a call to the switch takes, and how far the gap between exposures is used up by it.
  double call_s = 0.0;
};

class LightPlan {
 public:
  /// @param options  valid ones
  explicit LightPlan(const LightPlanOptions& options = {});

  /// The requests that begin before `until_s` and were not returned yet.
  [[nodiscard]] std::vector<device::LightRequest> plan(double now_s, double until_s,
                                                       const CameraBeat& beat);

  /// From when on the lights keep step with the camera, as of the latest request.
  [[nodiscard]] std::optional<double> in_step_since_s() const { return in_step_since_s_; }
  /// Frames that each pattern stays for, as of the latest request.
  [[nodiscard]] int frames_per_pattern() const { return frames_per_pattern_; }

 private:
  struct Slot {
    device::Light light = device::Light::kDark;
    double duration_s = 0.0;
  };
  [[nodiscard]] Slot next_slot(const CameraBeat& beat);
  [[nodiscard]] Slot learning_slot(double period_s);
  [[nodiscard]] device::Light next_pattern();
  void choose_frames_per_pattern(const CameraBeat& beat);
  [[nodiscard]] double into_gap(double time_s, const CameraBeat& beat) const;

  LightPlanOptions options_;
  Random random_;
  Pattern pattern_ = Pattern::kHorizontal;  // of the latest slot
  bool is_started_ = false;
  double next_s_ = 0.0;   // begin of the next slot
  double flash_s_ = 0.0;  // begin of the latest flash
  std::optional<double> in_step_since_s_;
  int learning_slots_ = 0;
  int frames_per_pattern_ = 1;
};

}  // namespace flytri::sync
