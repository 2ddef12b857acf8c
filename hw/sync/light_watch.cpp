#include "hw/sync/light_watch.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check_options.h"

namespace flytri::sync {
namespace {

// Pattern changes after which equal images cannot be a coincidence.
constexpr std::int64_t kSwitchingsToBeStuck = 10;
// Frames during a flash that must show no flash; few, because flashes are rare.
constexpr int kFlashesToMiss = 3;

bool shows(const LightEvidence& evidence, device::Light light) {
  return light == device::Light::kFlash ? evidence.is_flash : evidence.has_lines;
}

}  // namespace

std::string message_of(LightFault fault) {
  switch (fault) {
    case LightFault::kNone:
      return {};
    case LightFault::kSwapped:
      return "The vertical and the horizontal projector are swapped: exchange their cables, or the "
             "lines \"vertical\" and \"horizontal\" in rig.json. Until then, frames are labeled by "
             "the pattern that they show.";
    case LightFault::kStuck:
      return "The lights do not change although the light switch reports success: check its cable "
             "and power, then unplug it and plug it in again.";
    case LightFault::kNoVertical:
      return "No image shows the vertical lines: check the cable and power of the vertical "
             "projector "
             "and its line in rig.json.";
    case LightFault::kNoHorizontal:
      return "No image shows the horizontal lines: check the cable and power of the horizontal "
             "projector and its line in rig.json.";
    case LightFault::kNoFlash:
      return "No image shows the flash: check its cable and power and its line in rig.json.";
    case LightFault::kUnrelated:
      return fmt::format(
          "The images do not follow the lights. They may come more than {:.0f} frames late: plug "
          "the camera in without a hub, or choose a smaller size_px in rig.json. Or the camera "
          "does "
          "not see these projectors: check cameras and lights in rig.json.",
          LatencyOptions{}.max_latency_periods);
    case LightFault::kNothingSeen:
      break;
  }
  return "No image shows projected light yet: hold the sensor over the teeth. If it is over the "
         "teeth, check the cables and power of the projectors and the exposure of the camera.";
}

Result<void> WatchOptions::validate() const {
  return OptionCheck("WatchOptions")
      .in_range("memory", memory, 20, 10000)
      .at_least("enough", enough, 5)
      .must("enough", enough, enough <= memory, "at most memory")
      .in_range("alike", alike, 0.0, 1.0)
      .in_range("brighter_all_over", brighter_all_over, 0.0, 1.0)
      .result();
}

void LightWatch::add(const Seen& seen) {
  seen_.push_back(seen);
  if (seen_.size() > static_cast<std::size_t>(options_.memory)) seen_.pop_front();
  any_light_ |= !seen.evidence.is_empty();
  ++frames_;
}

bool LightWatch::is_stuck() const {
  double least = 1.0, most = 0.0;
  int lines = 0, dark = 0;
  std::int64_t first = 0, last = 0;
  for (const Seen& seen : seen_) {
    if (seen.evidence.is_flash) return false;
    dark += seen.evidence.has_lines ? 0 : 1;
    if (!seen.evidence.has_lines) continue;
    if (lines++ == 0) first = seen.switchings;
    last = seen.switchings;
    least = std::min(least, seen.evidence.column_share);
    most = std::max(most, seen.evidence.column_share);
  }
  // If half of the images are empty, one pattern may be missing, which is another fault.
  return lines >= options_.enough && lines > 2 * dark && last - first >= kSwitchingsToBeStuck &&
         most - least < options_.alike;
}

double LightWatch::darkest_with_lines() const {
  double sum = 0.0;
  int count = 0;
  for (const Seen& seen : seen_) {
    if (!seen.evidence.has_lines) continue;
    sum += seen.evidence.darkest;
    ++count;
  }
  return sum / std::max(count, 1);
}

bool LightWatch::is_missing(device::Light light) const {
  int expected = 0, others = 0;
  const double darkest = darkest_with_lines();
  for (const Seen& seen : seen_) {
    if (!seen.expected || *seen.expected == device::Light::kDark) continue;
    if (*seen.expected != light) {
      others += shows(seen.evidence, *seen.expected) ? 1 : 0;
    } else if (shows(seen.evidence, light)) {
      return false;
    } else if (light != device::Light::kFlash || seen.evidence.has_lines ||
               seen.evidence.darkest < darkest + options_.brighter_all_over) {
      ++expected;
    }
  }
  return expected >= (light == device::Light::kFlash ? kFlashesToMiss : options_.enough) &&
         others >= options_.enough;
}

LightFault LightWatch::fault(bool is_swapped, bool is_unrelated) const {
  if (is_stuck()) return LightFault::kStuck;
  if (is_unrelated && frames_ >= options_.enough) return LightFault::kUnrelated;
  if (is_swapped) return LightFault::kSwapped;
  if (is_missing(device::Light::kVertical)) return LightFault::kNoVertical;
  if (is_missing(device::Light::kHorizontal)) return LightFault::kNoHorizontal;
  if (is_missing(device::Light::kFlash)) return LightFault::kNoFlash;
  return !any_light_ && frames_ >= options_.memory ? LightFault::kNothingSeen : LightFault::kNone;
}

}  // namespace flytri::sync
