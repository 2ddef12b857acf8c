#include "core/texture/merge_observations.h"

#include <algorithm>

namespace flytri::texture {
namespace {

/// Below the median: a highlight is brighter, and often seen from where the weight is large.
constexpr float kStartQuantile = 0.35F;
/// Relative difference in brightness that halves the weight. Frames agree within some percent.
constexpr float kAgreement = 0.1F;
constexpr int kMergeRounds = 6;

Vec3f weighted_mean(std::span<const Observation> seen, float around) {
  Vec3f sum = Vec3f::Zero();
  float weight = 0.0F;
  for (const Observation& observation : seen) {
    const float off = (observation.albedo.mean() - around) / (kAgreement * around);
    const float w = observation.weight / (1.0F + off * off);
    sum += w * observation.albedo;
    weight += w;
  }
  return sum / weight;
}

/// Brightness at the start quantile of the weights. Interpolated, so that nothing jumps where the
/// weights change from place to place.
float start_of(std::span<Observation> seen) {
  // By insertion: few frames see a place.
  for (auto it = seen.begin(); it != seen.end(); ++it) {
    const auto place = std::upper_bound(
        seen.begin(), it, *it,
        [](const Observation& a, const Observation& b) { return a.albedo.sum() < b.albedo.sum(); });
    std::rotate(place, it, it + 1);
  }
  float total = 0.0F;
  for (const Observation& observation : seen) total += observation.weight;
  const float wanted = kStartQuantile * total;
  float passed = 0.0F, place = 0.0F, brightness = 0.0F;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const float next_place = passed + 0.5F * seen[i].weight;
    const float next_brightness = seen[i].albedo.mean();
    if (next_place >= wanted) {
      if (i == 0) return next_brightness;
      const float share = (wanted - place) / (next_place - place);
      return brightness + share * (next_brightness - brightness);
    }
    passed += seen[i].weight;
    place = next_place;
    brightness = next_brightness;
  }
  return brightness;
}

}  // namespace

Vec3f merge_observations(std::span<Observation> seen) {
  if (seen.size() == 1) return seen.front().albedo;
  float around = start_of(seen);
  Vec3f merged = Vec3f::Constant(around);
  for (int round = 0; round < kMergeRounds; ++round) {
    merged = weighted_mean(seen, around);
    around = merged.mean();
  }
  return merged;
}

}  // namespace flytri::texture
