#include "app/lab/closed_jaws.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/base/random.h"
#include "core/evaluation/surface_error.h"
#include "core/geometry/append_mesh.h"
#include "core/geometry/cell_key.h"
#include "hw/simulated/hand/aimed_pose.h"
#include "hw/simulated/hand/arch_line.h"

namespace flytri::lab {
namespace {

/// Columns in which the jaws are compared: finer than the edges of their triangles.
constexpr double kColumn_mm = 0.1;

/// How far the lower jaw must move along z of the upper one until both touch.
double gap_mm(const TriangleMesh& upper, const TriangleMesh& lower, const Isometry& T_upper_lower) {
  std::unordered_map<CellKey, double> heights_mm;
  const auto column = [](const Vec3& p_mm) {
    return CellKey::at(Vec3(p_mm.x(), p_mm.y(), 0.0), kColumn_mm);
  };
  for (const SurfacePoint& vertex : upper.vertices) {
    const Vec3 p_mm = vertex.position_mm.cast<double>();
    const auto [at, is_new] = heights_mm.emplace(column(p_mm), p_mm.z());
    if (!is_new) at->second = std::max(at->second, p_mm.z());
  }
  double gap_mm = 1e9;
  for (const SurfacePoint& vertex : lower.vertices) {
    const Vec3 p_mm = T_upper_lower * vertex.position_mm.cast<double>();
    const auto at = heights_mm.find(column(p_mm));
    if (at != heights_mm.end()) gap_mm = std::min(gap_mm, p_mm.z() - at->second);
  }
  return gap_mm;
}

/// Along the teeth of one side and back, a little higher and lower: the share of the arch at a
/// share of the time, and the tilt up or down.
std::pair<double, double> bite_aim(double time, bool is_right) {
  constexpr double kMolar = 0.06, kCanine = 0.36, kTilt_rad = 0.25;
  const double along = 1.0 - std::abs(2.0 * time - 1.0);
  const double share = kMolar + (kCanine - kMolar) * along;
  return {is_right ? 1.0 - share : share, kTilt_rad * std::sin(6.0 * std::numbers::pi * time)};
}

}  // namespace

Result<ClosedJaws> close_sample_jaws(std::uint64_t seed, const Workers& workers) {
  sample_jaw::SampleJawOptions options;
  options.seed = seed;
  auto upper = sample_jaw::make_sample_jaw(options, workers);
  if (!upper) return tl::unexpected(upper.error());
  options.kind = JawKind::kLower;
  auto lower = sample_jaw::make_sample_jaw(options, workers);
  if (!lower) return tl::unexpected(lower.error());
  Random random(seed, 77);
  Twist shift;
  for (int i = 0; i < 6; ++i) shift[i] = random.uniform(-1.0, 1.0) * (i < 3 ? 0.015 : 0.5);
  // Half a turn about y: z points to the opposing teeth in both frames.
  Isometry T_upper_lower = exp_twist(shift) * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY());
  T_upper_lower.pretranslate(Vec3(0.0, 0.0, 100.0));
  T_upper_lower.pretranslate(Vec3(0.0, 0.0, -gap_mm(*upper, *lower, T_upper_lower)));
  ClosedJaws jaws;
  jaws.upper = *std::move(upper);
  jaws.lower = *std::move(lower);
  jaws.T_upper_lower = T_upper_lower;
  jaws.closed = jaws.upper;
  append(jaws.closed, evaluation::transformed(jaws.lower, T_upper_lower));
  const simulated::RayScene scene(jaws.upper);
  const auto line = simulated::find_arch_line(scene, {});
  if (!line) return tl::unexpected(line.error());
  jaws.ends_mm = {line->front(), line->back()};
  return jaws;
}

Result<SimulatedScan> scan_bite(const ClosedJaws& jaws, bool is_right, int view_count,
                                std::uint64_t seed, const Workers& workers,
                                const Progress& progress) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  const simulated::RayScene alone(jaws.upper), closed(jaws.closed);
  const auto line = simulated::find_arch_line(alone, {});
  if (!line) return tl::unexpected(line.error());
  const auto point = [&](double share) {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(line->size() - 1);
    return (*line)[static_cast<std::size_t>(place)];
  };
  std::vector<simulated::PathPose> poses;
  for (int i = 0; i < view_count; ++i) {
    const auto [share, tilt_rad] = bite_aim(i / (view_count - 1.0), is_right);
    Vec3 along = point(share + 0.08) - point(share - 0.08);
    along.z() = 0.0;
    along.normalize();
    const Vec3 outward = Vec3::UnitZ().cross(along);
    const Vec3 towards = std::cos(tilt_rad) * outward + std::sin(tilt_rad) * Vec3::UnitZ();
    Isometry T_model_sensor = simulated::aimed_pose({point(share), towards, along});
    if (const auto depth_mm = simulated::surface_depth(closed, sensor, T_model_sensor)) {
      T_model_sensor = T_model_sensor * Eigen::Translation3d(0.0, 0.0, *depth_mm);
    }
    poses.push_back({i * sensor.frame_period_s, T_model_sensor});
  }
  SimulatedScanOptions options;
  options.view_count = view_count;
  options.noise.seed = seed;
  options.noise.correlation_samples = 1.5;
  return simulate_scan_along(jaws.closed, sensor,
                             *simulated::SensorPath::from_poses(std::move(poses)), options, workers,
                             progress);
}

}  // namespace flytri::lab
