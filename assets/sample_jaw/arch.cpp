#include "assets/sample_jaw/arch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flytri::sample_jaw {
namespace {

constexpr double kStep_mm = 0.25;
// Length of the straight ends, which extend the gum behind the last teeth.
constexpr double kEnd_mm = 14.0;
constexpr std::size_t kCoarseStride = 16;

// Points at equal distances along one half of the arch, from the middle to its straight end.
std::vector<Vec2> sample_half(double half_width_mm, double depth_mm) {
  constexpr int kFineSteps = 20000;
  std::vector<Vec2> samples;
  Vec2 last(0.0, depth_mm);
  double walked_mm = 0.0;
  for (int i = 1; i <= kFineSteps; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kFineSteps;
    const Vec2 next(half_width_mm * std::sin(angle), depth_mm * std::cos(angle));
    walked_mm += (next - last).norm();
    last = next;
    if (walked_mm >= kStep_mm * static_cast<double>(samples.size() + 1)) samples.push_back(next);
  }
  const Vec2 end = samples.back();
  for (int step = 1; step * kStep_mm < kEnd_mm; ++step)
    samples.emplace_back(end.x(), end.y() - step * kStep_mm);
  return samples;
}

}  // namespace

Arch::Arch(double half_width_mm, double depth_mm) {
  const std::vector<Vec2> half = sample_half(half_width_mm, depth_mm);
  for (auto it = half.rbegin(); it != half.rend(); ++it) samples_.emplace_back(-it->x(), it->y());
  samples_.emplace_back(0.0, depth_mm);
  samples_.insert(samples_.end(), half.begin(), half.end());
}

double Arch::along_of(std::size_t sample) const {
  return kStep_mm * (static_cast<double>(sample) - 0.5 * static_cast<double>(samples_.size() - 1));
}

Vec2 Arch::point(double along_mm) const {
  const double last = static_cast<double>(samples_.size() - 1);
  const double place = std::clamp(along_mm / kStep_mm + 0.5 * last, 0.0, last - 1e-9);
  const auto i = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(i);
  return (1.0 - share) * samples_[i] + share * samples_[i + 1];
}

Vec2 Arch::tangent(double along_mm) const {
  return (point(along_mm + kStep_mm) - point(along_mm - kStep_mm)).normalized();
}

Vec2 Arch::outward(double along_mm) const {
  const Vec2 along = tangent(along_mm);
  return {-along.y(), along.x()};
}

ArchPlace Arch::locate(const Vec2& p) const {
  const auto squared = [&](std::size_t i) { return (samples_[i] - p).squaredNorm(); };
  std::size_t best = 0;
  for (std::size_t i = 0; i < samples_.size(); i += kCoarseStride)
    if (squared(i) < squared(best)) best = i;
  const std::size_t begin = best < kCoarseStride ? 0 : best - kCoarseStride;
  const std::size_t end = std::min(best + kCoarseStride + 1, samples_.size());
  for (std::size_t i = begin; i < end; ++i)
    if (squared(i) < squared(best)) best = i;
  const Vec2 along = tangent(along_of(best));
  const Vec2 offset = p - samples_[best];
  return {along_of(best) + offset.dot(along), offset.dot(Vec2(-along.y(), along.x()))};
}

}  // namespace flytri::sample_jaw
