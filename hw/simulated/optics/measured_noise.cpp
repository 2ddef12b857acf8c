#include "hw/simulated/optics/measured_noise.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace flytri::simulated {

Result<MeasuredNoise> MeasuredNoise::create(const std::vector<NoiseSeries>& series) {
  std::array<std::map<double, Depth>, 2> by_depth;
  for (const NoiseSeries& one : series) {
    Depth& depth = by_depth[static_cast<std::size_t>(one.pattern)][one.z_mm];
    depth.z_mm = one.z_mm;
    depth.ends.push_back(one.samples.size() + (depth.ends.empty() ? 0 : depth.ends.back()));
    depth.series.push_back(one.samples);
  }
  MeasuredNoise noise;
  for (const Pattern pattern : kPatterns) {
    const auto p = static_cast<std::size_t>(pattern);
    if (by_depth[p].empty()) {
      return fail(ErrorCode::kInsufficient,
                  "too few samples of the {} lines for their noise; give planes "
                  "whose images show them",
                  to_string(pattern));
    }
    for (auto& [z_mm, depth] : by_depth[p]) noise.depths_[p].push_back(std::move(depth));
  }
  return noise;
}

std::vector<NoiseSample> MeasuredNoise::draw(Pattern pattern, const Profile& profile,
                                             Random& random) const {
  const std::vector<ProfilePoint>& points = profile.points;
  std::vector<NoiseSample> drawn;
  drawn.reserve(points.size());
  while (drawn.size() < points.size()) {
    const Depth& depth = nearest(pattern, points[drawn.size()].position_mm.z());
    const std::size_t start = random.below(depth.ends.back());
    const bool forward = random.below(2) == 0;
    const float sign = random.below(2) == 0 ? 1.0F : -1.0F;
    const auto found = std::upper_bound(depth.ends.begin(), depth.ends.end(), start);
    const auto& series = depth.series[static_cast<std::size_t>(found - depth.ends.begin())];
    std::size_t at = start - (*found - series.size());
    do {
      drawn.push_back({sign * series[at].off_mm, series[at].stated_mm});
      at += forward ? 1 : -1;  // before the first one it wraps to a value past the end
    } while (at < series.size() && drawn.size() < points.size() &&
             &nearest(pattern, points[drawn.size()].position_mm.z()) == &depth);
  }
  return drawn;
}

std::vector<double> MeasuredNoise::depths_mm(Pattern pattern) const {
  std::vector<double> depths;
  for (const Depth& depth : depths_[static_cast<std::size_t>(pattern)]) {
    depths.push_back(depth.z_mm);
  }
  return depths;
}

const MeasuredNoise::Depth& MeasuredNoise::nearest(Pattern pattern, double z_mm) const {
  const std::vector<Depth>& depths = depths_[static_cast<std::size_t>(pattern)];
  const auto off_mm = [&](const Depth& depth) { return std::abs(depth.z_mm - z_mm); };
  return *std::min_element(depths.begin(), depths.end(),
                           [&](const Depth& a, const Depth& b) { return off_mm(a) < off_mm(b); });
}

}  // namespace flytri::simulated
