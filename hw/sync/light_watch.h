/// @file  Tells from clock and images together what is wrong with the lights.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "hw/sync/latency_filter.h"
#include "hw/sync/light_evidence.h"

namespace flytri::sync {

/// kSwapped: the vertical projector shines where the horizontal one was told to, and the reverse.
/// kStuck: the switch reports success, but the image never changes. kNothingSeen: no image has
/// shown any light since the start, which may be the scene's fault.
enum class LightFault {
  kNone,
  kSwapped,
  kStuck,
  kNoVertical,
  kNoHorizontal,
  kNoFlash,
  kNothingSeen
};

/// What it is and its remedy; empty for kNone.
[[nodiscard]] std::string message_of(LightFault fault);

struct WatchOptions {
  /// 20..10000 frames that are looked back on: four seconds at 30 Hz, with four flashes.
  int memory = 120;
  /// 5..10000. Frames that a light must be missing in, or all be alike in, to be named.
  int enough = 30;
  /// 0..1. Spread of the share of light in columns below which images are alike.
  double alike = 0.2;
  [[nodiscard]] Result<void> validate() const;
};

class LightWatch {
 public:
  /// @param options  valid ones
  explicit LightWatch(const WatchOptions& options = {}) : options_(options) {}

  struct Seen {
    std::optional<device::Light> expected;  ///< by the clock; none where it is not sure
    LightEvidence evidence;
    std::int64_t switchings = 0;  ///< between patterns, that the switch has reported so far
  };
  void add(const Seen& seen);

  /// @param is_swapped  by the filter, beyond doubt
  [[nodiscard]] LightFault fault(bool is_swapped) const;

 private:
  [[nodiscard]] bool is_stuck() const;
  [[nodiscard]] bool is_missing(device::Light light) const;

  WatchOptions options_;
  std::deque<Seen> seen_;
  bool any_light_ = false;
  std::int64_t frames_ = 0;
};

}  // namespace flytri::sync
