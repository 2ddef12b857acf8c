#include "core/meshing/hole_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/meshing/least_angle.h"

namespace flytri::meshing {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

double area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

/// The triangles at each edge, with the corner opposite to it.
struct Opposite {
  std::uint32_t triangle, corner;
};
std::map<Edge, std::vector<Opposite>> edges_of(const HolePatch& patch) {
  std::map<Edge, std::vector<Opposite>> edges;
  for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
    const Triangle& p = patch.triangles[t];
    for (std::size_t k = 0; k < 3; ++k)
      edges[edge_of(p[k], p[(k + 1) % 3])].push_back({t, p[(k + 2) % 3]});
  }
  return edges;
}

/// Turns every edge between two triangles where this makes the smallest of their angles larger.
bool turn_edges(HolePatch& patch, const std::vector<char>& is_forbidden, std::size_t rim_count) {
  auto edges = edges_of(patch);
  std::set<std::uint32_t> touched;
  bool has_turned = false;
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2 ||
        touched.count(sides[0].triangle) + touched.count(sides[1].triangle) > 0)
      continue;
    const std::uint32_t c = sides[0].corner, d = sides[1].corner;
    const bool is_known = c < rim_count && d < rim_count && is_forbidden[c * rim_count + d] != 0;
    if (c == d || is_known || edges.count(edge_of(c, d)) > 0) continue;
    // As the first triangle runs through the edge: from a to b.
    const Triangle& first = patch.triangles[sides[0].triangle];
    const auto at =
        static_cast<std::size_t>(std::find(first.begin(), first.end(), c) - first.begin());
    const std::uint32_t a = first[(at + 1) % 3], b = first[(at + 2) % 3];
    const auto p = [&](std::uint32_t v) -> const Vec3& { return patch.corners_mm[v]; };
    const Vec3 one = (p(d) - p(a)).cross(p(c) - p(a)), other = (p(b) - p(d)).cross(p(c) - p(d));
    const double before =
        std::min(sine_of_least_angle(p(a), p(b), p(c)), sine_of_least_angle(p(b), p(a), p(d)));
    const double after =
        std::min(sine_of_least_angle(p(a), p(d), p(c)), sine_of_least_angle(p(d), p(b), p(c)));
    if (after <= before * 1.0001 || one.dot(other) <= 0.0) continue;
    patch.triangles[sides[0].triangle] = {a, d, c};
    patch.triangles[sides[1].triangle] = {d, b, c};
    touched.insert({sides[0].triangle, sides[1].triangle});
    edges[edge_of(c, d)];  // is taken from now on
    has_turned = true;
  }
  return has_turned;
}

/// Halves every edge inside that is longer, where its triangles are not yet touched.
bool split_edges(HolePatch& patch, double longest_mm) {
  const auto edges = edges_of(patch);
  std::vector<std::pair<double, Edge>> too_long;
  for (const auto& [edge, sides] : edges) {
    const double length_mm = (patch.corners_mm[edge.first] - patch.corners_mm[edge.second]).norm();
    if (sides.size() == 2 && length_mm > longest_mm) too_long.emplace_back(-length_mm, edge);
  }
  std::sort(too_long.begin(), too_long.end());
  std::set<std::uint32_t> touched;
  for (const auto& [minus_length, edge] : too_long) {
    const std::vector<Opposite>& sides = edges.at(edge);
    if (touched.count(sides[0].triangle) + touched.count(sides[1].triangle) > 0) continue;
    const auto middle = static_cast<std::uint32_t>(patch.corners_mm.size());
    patch.corners_mm.emplace_back(0.5 *
                                  (patch.corners_mm[edge.first] + patch.corners_mm[edge.second]));
    for (const Opposite& side : sides) {
      touched.insert(side.triangle);
      Triangle half = patch.triangles[side.triangle];
      std::replace(half.begin(), half.end(), edge.first, middle);
      std::replace(patch.triangles[side.triangle].begin(), patch.triangles[side.triangle].end(),
                   edge.second, middle);
      patch.triangles.push_back(half);
    }
  }
  return !touched.empty();
}

/// A corner's neighbors and what each weighs: the nearer, the more.
struct Ring {
  std::vector<std::pair<std::uint32_t, double>> corners;
  Vec3 fixed = Vec3::Zero();  ///< sum of the neighbors outside of the patch
};

/// The bending at each corner, linear in the inner corners: (mean of the neighbors) - corner.
class Bending {
 public:
  Bending(const HolePatch& patch, const OuterNeighbors& outer)
      : rim_count_(outer.size()), rings_(patch.corners_mm.size()) {
    std::vector<std::set<std::uint32_t>> neighbors(patch.corners_mm.size());
    for (const Triangle& t : patch.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        neighbors[t[k]].insert(t[(k + 1) % 3]);
        neighbors[t[(k + 1) % 3]].insert(t[k]);
      }
    }
    for (std::uint32_t v = 0; v < rings_.size(); ++v) weigh(patch, outer, neighbors[v], v);
  }

  /// @param x  of all corners; the rim's stay
  [[nodiscard]] std::vector<Vec3> at(const std::vector<Vec3>& x, bool with_outer) const {
    std::vector<Vec3> bending(rings_.size());
    for (std::size_t v = 0; v < rings_.size(); ++v) {
      Vec3 sum = -x[v];
      if (with_outer) sum += rings_[v].fixed;
      for (const auto& [w, weight] : rings_[v].corners) sum += weight * x[w];
      bending[v] = sum;
    }
    return bending;
  }
  /// The transposed of at(), for the inner corners.
  [[nodiscard]] std::vector<Vec3> transposed(const std::vector<Vec3>& bending) const {
    std::vector<Vec3> x(rings_.size(), Vec3::Zero());
    for (std::size_t v = 0; v < rings_.size(); ++v) {
      x[v] -= bending[v];
      for (const auto& [w, weight] : rings_[v].corners) x[w] += weight * bending[v];
    }
    std::fill(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(rim_count_), Vec3::Zero());
    return x;
  }

 private:
  void weigh(const HolePatch& patch, const OuterNeighbors& outer,
             const std::set<std::uint32_t>& neighbors, std::uint32_t v) {
    Ring& ring = rings_[v];
    double sum = 0.0;
    const auto weight_of = [&](const Vec3& p) {
      const double weight = 1.0 / std::max((p - patch.corners_mm[v]).norm(), 1e-9);
      sum += weight;
      return weight;
    };
    for (const std::uint32_t w : neighbors)
      ring.corners.emplace_back(w, weight_of(patch.corners_mm[w]));
    if (v < rim_count_) {
      for (const Vec3& p : outer[v]) ring.fixed += weight_of(p) * p;
    }
    for (auto& [w, weight] : ring.corners) weight /= sum;
    ring.fixed /= sum;
  }

  std::size_t rim_count_;
  std::vector<Ring> rings_;
};

double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

void add(std::vector<Vec3>& sum, double share, const std::vector<Vec3>& other) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * other[i];
}

/// Fills the rim between two of its corners. @param best  third corner of each pair
void add_triangles(const std::vector<std::uint32_t>& best, std::uint32_t count, std::uint32_t from,
                   std::uint32_t to, std::vector<Triangle>& triangles) {
  std::vector<Edge> open = {{from, to}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::uint32_t k = best[i * count + j];
    triangles.push_back({i, k, j});
    open.emplace_back(i, k);
    open.emplace_back(k, j);
  }
}

}  // namespace

std::optional<HolePatch> least_area_patch(const std::vector<Vec3>& rim_mm,
                                          const std::vector<char>& is_edge) {
  constexpr double kImpossible = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::uint32_t>(rim_mm.size());
  std::vector<double> area(rim_mm.size() * count, 0.0);
  std::vector<std::uint32_t> best(area.size(), 0);
  for (std::uint32_t span = 2; span < count; ++span) {
    for (std::uint32_t i = 0; i + span < count; ++i) {
      const std::uint32_t j = i + span;
      double least = kImpossible;
      const bool closes_rim = span == count - 1;
      if (closes_rim || is_edge[i * count + j] == 0) {
        for (std::uint32_t k = i + 1; k < j; ++k) {
          const double sum =
              area[i * count + k] + area[k * count + j] + area_of(rim_mm[i], rim_mm[k], rim_mm[j]);
          if (sum < least) least = sum, best[i * count + j] = k;
        }
      }
      area[i * count + j] = least;
    }
  }
  if (!(area[count - 1] < kImpossible)) return std::nullopt;
  HolePatch patch;
  patch.corners_mm = rim_mm;
  add_triangles(best, count, 0, count - 1, patch.triangles);
  return patch;
}

void refine_patch(HolePatch& patch, const std::vector<char>& is_edge, std::size_t rim_count) {
  // Halves of the longest edge that stays are no shorter than 2/3 of the rim's edges.
  constexpr double kLongest = 4.0 / 3.0;
  constexpr int kMostRounds = 40;
  double rim_mm = 0.0;
  for (std::size_t i = 0; i < rim_count; ++i)
    rim_mm += (patch.corners_mm[(i + 1) % rim_count] - patch.corners_mm[i]).norm();
  const double longest_mm = kLongest * rim_mm / static_cast<double>(rim_count);
  for (int round = 0; round < kMostRounds; ++round) {
    const bool has_split = split_edges(patch, longest_mm);
    for (int turn = 0; turn < kMostRounds && turn_edges(patch, is_edge, rim_count); ++turn) {
    }
    if (!has_split) return;
  }
}

void fair_patch(HolePatch& patch, const OuterNeighbors& outer) {
  constexpr int kMostSteps = 3000;
  constexpr double kPrecise = 1e-18;  // of the squared gradient
  const Bending bending(patch, outer);
  // Least squares by conjugate gradients (CGLS): the rim stays, what is inside moves.
  std::vector<Vec3>& x = patch.corners_mm;
  std::vector<Vec3> rest = bending.at(x, true);
  for (Vec3& r : rest) r = -r;
  std::vector<Vec3> gradient = bending.transposed(rest), direction = gradient;
  double square = dot(gradient, gradient);
  const double enough = kPrecise * square;
  for (int step = 0; step < kMostSteps && square > enough; ++step) {
    const std::vector<Vec3> change = bending.at(direction, false);
    const double length = square / dot(change, change);
    add(x, length, direction);
    add(rest, -length, change);
    gradient = bending.transposed(rest);
    const double former = std::exchange(square, dot(gradient, gradient));
    for (std::size_t i = 0; i < x.size(); ++i)
      direction[i] = gradient[i] + square / former * direction[i];
  }
}

}  // namespace flytri::meshing
