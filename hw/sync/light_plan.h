/// @file  Plans when each light is on: the sequence of the paper, synchronized with the camera.
///
/// While the latency is unknown, patterns and times are random: a regular sequence looks the same
/// when it is shifted by a period. Once it is known, the light changes between exposures, one frame
/// per pattern. Where the gaps are too short, a pattern stays on for two frames, of which one is
/// whole.
/// @source  Arold et al., "Sensor Setup" (alternating patterns) and "Texture Acquisition and
///          Mapping" (the acquisition is interrupted about every second for a flash).
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
  /// False: a dark slot replaces the flash, so that the sequence stays aperiodic.
  bool has_flash = true;
  /// > 0. Time between two flashes.
  double flash_period_s = 1.0;
  /// 1..10. Duration of a flash in frames of the measurement camera; a whole exposure of the
  /// texture camera must fit in.
  int flash_frames = 2;
  /// 0..1. Largest share of time that flashes take, also while the latency is learned.
  double flash_duty = 0.25;
  /// 0..0.5 periods. Least distance between a switch and an exposure; if the gaps are shorter, two
  /// frames per pattern are used.
  double margin = 0.15;
  std::uint64_t seed = 1;  ///< seed of the random times
  [[nodiscard]] Result<void> validate() const;
};

/// Timing of the camera, as known so far.
struct CameraTiming {
  FrameClock clock;
  LatencyEstimate latency;
  bool is_learned = false;
  /// Duration of a call to the switch; it shortens the usable gap between exposures.
  double call_s = 0.0;
};

class LightPlan {
 public:
  /// @param options  must be valid
  explicit LightPlan(const LightPlanOptions& options = {});

  /// The next requests, up to those that begin before `until_s`.
  [[nodiscard]] std::vector<device::LightRequest> plan(double now_s, double until_s,
                                                       const CameraTiming& timing);

  /// Since when the lights are synchronized with the camera, as of the latest request.
  [[nodiscard]] std::optional<double> in_step_since_s() const { return in_step_since_s_; }
  /// Frame periods per pattern, as of the latest request.
  [[nodiscard]] int frames_per_pattern() const { return frames_per_pattern_; }

 private:
  struct Slot {
    device::Light light = device::Light::kDark;
    double duration_s = 0.0;
  };
  [[nodiscard]] Slot next_slot(const CameraTiming& timing);
  [[nodiscard]] Slot learning_slot(double period_s);
  [[nodiscard]] bool may_flash(double period_s) const;
  [[nodiscard]] device::Light next_pattern();
  void choose_frames_per_pattern(const CameraTiming& timing);
  [[nodiscard]] double into_gap(double time_s, const CameraTiming& timing) const;

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
