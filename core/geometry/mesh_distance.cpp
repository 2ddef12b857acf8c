#include "core/geometry/mesh_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace flytri {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;

float squared_distance_to_box(const Vec3f& p, const Vec3f& low, const Vec3f& high) {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0F).squaredNorm();
}

// The closest point on the segment from a to b.
Vec3f closest_on_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f along = b - a;
  const float length2 = along.squaredNorm();
  if (!(length2 > 0.0F)) return a;
  return a + std::clamp((p - a).dot(along) / length2, 0.0F, 1.0F) * along;
}

}  // namespace

Vec3f closest_on_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f normal = (b - a).cross(c - a);
  const bool beyond_ab = normal.cross(b - a).dot(p - a) <= 0.0F;
  const bool beyond_bc = normal.cross(c - b).dot(p - b) <= 0.0F;
  const bool beyond_ca = normal.cross(a - c).dot(p - c) <= 0.0F;
  if (!beyond_ab && !beyond_bc && !beyond_ca)
    return p - (p - a).dot(normal) / normal.squaredNorm() * normal;
  // The closest point is on one of the three edges. Trying all is exact for very thin triangles
  // too.
  const std::array candidates = {closest_on_segment(p, a, b), closest_on_segment(p, b, c),
                                 closest_on_segment(p, c, a)};
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const Vec3f& x, const Vec3f& y) {
                             return (x - p).squaredNorm() < (y - p).squaredNorm();
                           });
}

MeshDistance::MeshDistance(const TriangleMesh& mesh) {
  corners_.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Corners corners{mesh.vertices[t[0]].position_mm, mesh.vertices[t[1]].position_mm,
                          mesh.vertices[t[2]].position_mm, i};
    if (corners.a.allFinite() && corners.b.allFinite() && corners.c.allFinite())
      corners_.push_back(corners);
  }
  Node root;
  root.end = static_cast<std::uint32_t>(corners_.size());
  nodes_.push_back(root);
  // split() appends children, so the list grows during the loop.
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
}

void MeshDistance::split(std::uint32_t index) {
  Node& node = nodes_[index];
  node.low = Vec3f::Constant(std::numeric_limits<float>::max());
  node.high = -node.low;
  for (std::uint32_t i = node.begin; i < node.end; ++i)
    for (const Vec3f& corner : {corners_[i].a, corners_[i].b, corners_[i].c}) {
      node.low = node.low.cwiseMin(corner);
      node.high = node.high.cwiseMax(corner);
    }
  if (node.end - node.begin <= kLeafTriangles) return;
  int axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
  const auto center = [axis](const Corners& c) { return c.a[axis] + c.b[axis] + c.c[axis]; };
  std::nth_element(corners_.begin() + node.begin, corners_.begin() + middle,
                   corners_.begin() + node.end, [&](const Corners& x, const Corners& y) {
                     return std::pair(center(x), x.triangle) < std::pair(center(y), y.triangle);
                   });
  node.child = static_cast<std::uint32_t>(nodes_.size());
  Node left, right;
  left.begin = node.begin;
  left.end = right.begin = middle;
  right.end = node.end;
  nodes_.push_back(left);
  nodes_.push_back(right);
}

MeshDistance::Closest MeshDistance::closest(const Vec3f& query_mm, double limit_mm) const {
  return find(query_mm, limit_mm, Wanted::kClosest);
}

bool MeshDistance::is_within(const Vec3f& query_mm, double limit_mm) const {
  return find(query_mm, limit_mm, Wanted::kAny).distance_mm <= limit_mm;
}

MeshDistance::Closest MeshDistance::find(const Vec3f& query_mm, double limit_mm,
                                         Wanted wanted) const {
  // Enough for 2^32 triangles: each level halves them, and a leaf has up to 4.
  constexpr std::size_t kMaxDepth = 64;
  struct Pending {
    std::uint32_t node;
    float squared;
  };
  std::array<Pending, kMaxDepth> stack;
  std::size_t depth = 0;
  Closest best;
  best.distance_mm = std::numeric_limits<double>::infinity();
  float best_squared =
      limit_mm < 1e18 ? static_cast<float>(limit_mm * limit_mm) : std::numeric_limits<float>::max();
  const auto reach = [&](std::uint32_t node) {
    return squared_distance_to_box(query_mm, nodes_[node].low, nodes_[node].high);
  };
  if (!corners_.empty()) stack[depth++] = {0, reach(0)};
  while (depth > 0) {
    const Pending pending = stack[--depth];
    if (pending.squared > best_squared) continue;
    const Node& node = nodes_[pending.node];
    if (node.child != 0) {
      Pending near{node.child, reach(node.child)};
      Pending far{node.child + 1, reach(node.child + 1)};
      if (far.squared < near.squared) std::swap(near, far);
      stack[depth++] = far;
      stack[depth++] = near;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Corners& t = corners_[i];
      const Vec3f point = closest_on_triangle(query_mm, t.a, t.b, t.c);
      const float squared = (point - query_mm).squaredNorm();
      if (squared > best_squared) continue;
      best_squared = squared;
      best = {std::sqrt(static_cast<double>(squared)), point, t.triangle};
      if (wanted == Wanted::kAny && best.distance_mm <= limit_mm) return best;
    }
  }
  return best;
}

}  // namespace flytri
