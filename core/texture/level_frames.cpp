#include "core/texture/level_frames.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/median.h"

namespace flytri::texture {
namespace {

constexpr std::size_t kLevelPoints = 20000;  ///< places at which frames are compared, at most
/// Frames that share fewer places are not compared, and more do not count more.
constexpr std::size_t kFewestShared = 50, kMostShared = 1000;
/// A place counts if both frames see it well: this share of the weight straight before the camera.
constexpr float kWellSeen = 0.02F;
/// Pull of each gain to 1, in places: frames that no others overlap keep theirs.
constexpr double kPull = 5.0;
/// Frames that differ by more than this factor show something else than a brighter flash.
constexpr double kLargestGain = 2.0;

/// Logarithm of the color of a place in one frame.
struct SeenLog {
  std::size_t frame = 0;
  Eigen::Array3f log_albedo = Eigen::Array3f::Zero();
};

/// The differences of two frames at the places that both see.
using Shared = std::map<std::pair<std::size_t, std::size_t>, std::vector<Eigen::Array3f>>;

Shared compare(std::span<const FrameObserver> observers, std::span<const SurfacePoint> points,
               const Workers& workers) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / kLevelPoints);
  std::vector<std::vector<SeenLog>> seen((points.size() + step - 1) / step);
  workers.for_each(
      seen.size(),
      [&](std::size_t i) {
        const SurfacePoint& point = points[i * step];
        for (std::size_t f = 0; f < observers.size(); ++f) {
          if (!observers[f].may_see(point.position_mm, 0.0F)) continue;
          const auto observed = observers[f].observe(point);
          if (!observed || observed->weight < kWellSeen) continue;
          if (!(observed->albedo.minCoeff() > 0.0F)) continue;
          seen[i].push_back({f, observed->albedo.array().log()});
        }
      },
      256);
  Shared shared;
  for (const std::vector<SeenLog>& place : seen) {
    for (std::size_t a = 0; a < place.size(); ++a) {
      for (std::size_t b = a + 1; b < place.size(); ++b) {
        shared[{place[a].frame, place[b].frame}].push_back(place[a].log_albedo -
                                                           place[b].log_albedo);
      }
    }
  }
  return shared;
}

/// Logarithms of the gains of one channel, by frame: least squares over the median differences.
Eigen::VectorXd solve_channel(const Shared& shared, Eigen::Index frames, int channel) {
  Eigen::MatrixXd H = kPull * Eigen::MatrixXd::Identity(frames, frames);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(frames);
  for (const auto& [pair, differences] : shared) {
    if (differences.size() < kFewestShared) continue;
    std::vector<float> values;
    for (const Eigen::Array3f& difference : differences) values.push_back(difference[channel]);
    const double median = median_of(values);
    const auto weight = static_cast<double>(std::min(differences.size(), kMostShared));
    const auto a = static_cast<Eigen::Index>(pair.first),
               b = static_cast<Eigen::Index>(pair.second);
    H(a, a) += weight;
    H(b, b) += weight;
    H(a, b) -= weight;
    H(b, a) -= weight;
    g[a] -= weight * median;
    g[b] += weight * median;
  }
  const double most = std::log(kLargestGain);
  return H.ldlt().solve(g).cwiseMax(-most).cwiseMin(most);
}

}  // namespace

Result<void> level_frames(std::span<TextureFrame> frames, std::span<const SurfacePoint> points,
                          const calibration::Calibration& calibration,
                          const TextureOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return valid;
  for (TextureFrame& frame : frames) {
    if (auto fits = check_texture_image(frame.image, calibration); !fits) return fits;
    frame.gain = Vec3f::Ones();
  }
  if (frames.size() < 2) return {};
  const std::vector<BoundingSphere> spheres = block_spheres(points, workers);
  std::vector<FrameObserver> observers;
  observers.reserve(frames.size());
  for (const TextureFrame& frame : frames) {
    observers.emplace_back(frame, calibration, options);
    observers.back().find_depths(points, spheres, workers);
  }
  const Shared shared = compare(observers, points, workers);
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd logs =
        solve_channel(shared, static_cast<Eigen::Index>(frames.size()), channel);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      frames[f].gain[channel] = static_cast<float>(std::exp(logs[static_cast<Eigen::Index>(f)]));
    }
  }
  return {};
}

}  // namespace flytri::texture
