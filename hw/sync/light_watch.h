/// @file  Detects faults of the lights by comparing expected lights with images.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "hw/sync/latency_filter.h"
#include "hw/sync/light_evidence.h"

namespace flytri::sync {

/// kSwapped: the vertical projector lights up when the horizontal one should, and vice versa.
/// kStuck: the switch reports success, but the images do not change. kNothingSeen: no image since
/// the start shows any light; maybe no object is in front of the sensor. kUnrelated: the images
/// show light, but no latency explains when.
enum class LightFault {
  kNone,
  kSwapped,
  kStuck,
  kNoVertical,
  kNoHorizontal,
  kNoFlash,
  kNothingSeen,
  kUnrelated
};

/// The message for the user: the fault and what to do; empty for kNone.
[[nodiscard]] std::string message_of(LightFault fault);

struct WatchOptions {
  /// 20..10000. Number of latest frames that are examined; 120 are four seconds at 30 Hz, with four
  /// flashes.
  int memory = 120;
  /// 5..10000. Least number of frames that show a fault before it is reported.
  int enough = 30;
  /// 0..1. If the share of column light varies less than this, the images count as equal.
  double alike = 0.2;
  /// 0..1. An even surface shows no lines. If the image is brighter all over by this share of full
  /// scale, the flash is not missing.
  double brighter_all_over = 0.02;
  [[nodiscard]] Result<void> validate() const;
};

class LightWatch {
 public:
  /// @param options  must be valid
  explicit LightWatch(const WatchOptions& options = {}) : options_(options) {}

  struct Seen {
    std::optional<device::Light> expected;  ///< predicted from times; none if uncertain
    LightEvidence evidence;
    std::int64_t switchings = 0;  ///< pattern changes that the switch reported so far
  };
  void add(const Seen& seen);

  /// @param is_swapped    the filter is certain that the patterns are swapped
  /// @param is_unrelated  the filter is certain that no latency explains the images
  [[nodiscard]] LightFault fault(bool is_swapped, bool is_unrelated) const;

 private:
  [[nodiscard]] bool is_stuck() const;
  /// Mean of the images with lines.
  [[nodiscard]] double darkest_with_lines() const;
  [[nodiscard]] bool is_missing(device::Light light) const;

  WatchOptions options_;
  std::deque<Seen> seen_;
  bool any_light_ = false;
  std::int64_t frames_ = 0;
};

}  // namespace flytri::sync
