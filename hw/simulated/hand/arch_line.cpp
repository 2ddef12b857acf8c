#include "hw/simulated/hand/arch_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace flytri::simulated {
namespace {

constexpr int kSpokes = 73;
constexpr int kRaysPerSpoke = 160;
constexpr int kLinePoints = 200;
// Points in the top share of a spoke's height range count as teeth.
constexpr double kTopShare = 0.4;
// Distance of the hub from the back end of the jaw, as a share of the jaw's length; and the angle
// by which the outermost spokes point backwards, so that they reach the last teeth.
constexpr double kHubShare = 0.15;
constexpr double kBackwards_rad = 0.12;

// Bounding box of the jaw in its own axes.
struct JawBox {
  Vec3 low = Vec3::Constant(1e30);
  Vec3 high = Vec3::Constant(-1e30);
};

Vec3 in_axes(const JawAxes& axes, const Vec3& p) {
  return {p.dot(axes.right), p.dot(axes.front), p.dot(axes.up)};
}
Vec3 from_axes(const JawAxes& axes, const Vec3& p) {
  return p.x() * axes.right + p.y() * axes.front + p.z() * axes.up;
}

JawBox box_of(const RayScene& scene, const JawAxes& axes) {
  JawBox box;
  for (const SurfacePoint& vertex : scene.mesh().vertices) {
    const Vec3 p = in_axes(axes, vertex.position_mm.cast<double>());
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

// Mean of the high points on a spoke, in the jaw's axes.
std::optional<Vec3> top_of_spoke(const RayScene& scene, const JawAxes& axes, const JawBox& box,
                                 double angle_rad) {
  const Vec3 size = box.high - box.low;
  const Vec3 hub(0.5 * (box.low.x() + box.high.x()), box.low.y() + kHubShare * size.y(),
                 box.high.z() + 0.1 * size.norm());
  std::vector<Vec3> hits;
  for (int i = 0; i < kRaysPerSpoke; ++i) {
    const double radius = size.head<2>().norm() * i / kRaysPerSpoke;
    const Vec3 from = hub + radius * Vec3(std::sin(angle_rad), std::cos(angle_rad), 0.0);
    if (const auto hit = scene.first_hit({from_axes(axes, from), -axes.up}))
      hits.push_back(in_axes(axes, hit->point_mm));
  }
  if (hits.empty()) return std::nullopt;
  const auto [lowest, highest] = std::minmax_element(
      hits.begin(), hits.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  const double floor = highest->z() - kTopShare * (highest->z() - lowest->z());
  Vec3 sum = Vec3::Zero();
  double weight_sum = 0.0;
  for (const Vec3& hit : hits) {
    const double weight = std::max(hit.z() - floor, 1e-9);
    sum += weight * hit;
    weight_sum += weight;
  }
  return Vec3(sum / weight_sum);
}

// Moving average; the ends stay unchanged.
std::vector<Vec3> smoothed(const std::vector<Vec3>& line, int reach) {
  std::vector<Vec3> smooth(line.size());
  const int count = static_cast<int>(line.size());
  for (int i = 0; i < count; ++i) {
    const int half = std::min({reach, i, count - 1 - i});
    Vec3 sum = Vec3::Zero();
    for (int k = i - half; k <= i + half; ++k) sum += line[k];
    smooth[i] = sum / (2 * half + 1);
  }
  return smooth;
}

std::vector<Vec3> at_equal_distances(const std::vector<Vec3>& line) {
  std::vector<double> walked{0.0};
  for (std::size_t i = 1; i < line.size(); ++i)
    walked.push_back(walked.back() + (line[i] - line[i - 1]).norm());
  std::vector<Vec3> even;
  std::size_t segment = 0;
  for (int i = 0; i < kLinePoints; ++i) {
    const double distance = walked.back() * i / (kLinePoints - 1);
    while (segment + 2 < line.size() && walked[segment + 1] < distance) ++segment;
    const double length = std::max(walked[segment + 1] - walked[segment], 1e-12);
    const double share = (distance - walked[segment]) / length;
    even.push_back((1.0 - share) * line[segment] + share * line[segment + 1]);
  }
  return even;
}

}  // namespace

Result<std::vector<Vec3>> find_arch_line(const RayScene& scene, const JawAxes& axes) {
  const JawBox box = box_of(scene, axes);
  const double widest_rad = 0.5 * std::numbers::pi + kBackwards_rad;
  std::vector<Vec3> tops;
  for (int i = 0; i < kSpokes; ++i) {
    const double angle_rad = widest_rad * (2.0 * i / (kSpokes - 1) - 1.0);
    if (const auto top = top_of_spoke(scene, axes, box, angle_rad)) tops.push_back(*top);
  }
  if (tops.size() < 2)
    return fail(ErrorCode::kInsufficient,
                "no dental arch was found in the mesh: check the directions up and front");
  std::vector<Vec3> line = at_equal_distances(smoothed(smoothed(tops, 4), 4));
  for (Vec3& p : line) p = from_axes(axes, p);
  return line;
}

}  // namespace flytri::simulated
