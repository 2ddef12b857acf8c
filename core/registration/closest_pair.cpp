#include "core/registration/closest_pair.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flytri::registration {
namespace {

/// Keeps the closest pair; among equally close ones the first by (k, l), in any order of search.
struct BestPair {
  KnotPair pair;
  bool found = false;
  float limit = 0;  ///< squared

  void offer(const CubicCurve& first, const CubicCurve& second, std::size_t k, std::size_t l) {
    const float distance = (first.knot_mm(k) - second.knot_mm(l)).squaredNorm();
    if (distance > limit) return;
    const bool tie = found && distance == pair.squared_distance_mm2;
    if (tie && std::pair(k, l) > std::pair(pair.k, pair.l)) return;
    pair = {k, l, distance};
    limit = distance;
    found = true;
  }
};

BestPair nothing_within(double max_distance_mm) {
  return {{}, false, static_cast<float>(max_distance_mm * max_distance_mm)};
}

std::optional<KnotPair> result_of(const BestPair& best) {
  return best.found ? std::optional(best.pair) : std::nullopt;
}

/// Depth-first search over pairs of nodes, nearer children first.
class PairSearch {
 public:
  PairSearch(const PreparedProfile& first, const PreparedProfile& second, BestPair& best)
      : first_(first), second_(second), best_(best) {}

  void visit(std::uint32_t a, std::uint32_t b) {
    const BoxTree::Node& node_a = first_.tree.node(a);
    const BoxTree::Node& node_b = second_.tree.node(b);
    if (node_a.child == 0 && node_b.child == 0) return compare_leaves(node_a, node_b);
    const bool split_a = node_b.child == 0 || (node_a.child != 0 && node_a.box.largest_side() >=
                                                                        node_b.box.largest_side());
    const std::uint32_t child = split_a ? node_a.child : node_b.child;
    std::array<float, 2> distance{};
    for (std::uint32_t i = 0; i < 2; ++i) {
      distance[i] = split_a ? first_.tree.node(child + i).box.squared_distance(node_b.box)
                            : node_a.box.squared_distance(second_.tree.node(child + i).box);
    }
    const std::uint32_t nearer = distance[1] < distance[0] ? 1 : 0;
    for (const std::uint32_t i : {nearer, 1 - nearer}) {
      if (distance[i] > best_.limit) continue;
      split_a ? visit(child + i, b) : visit(a, child + i);
    }
  }

 private:
  void compare_leaves(const BoxTree::Node& a, const BoxTree::Node& b) {
    for (std::uint32_t k = a.begin; k < a.end; ++k) {
      for (std::uint32_t l = b.begin; l < b.end; ++l) {
        best_.offer(first_.curve, second_.curve, k, l);
      }
    }
  }

  const PreparedProfile& first_;
  const PreparedProfile& second_;
  BestPair& best_;
};

}  // namespace

std::optional<KnotPair> closest_knots_brute_force(const CubicCurve& first, const CubicCurve& second,
                                                  double max_distance_mm) {
  BestPair best = nothing_within(max_distance_mm);
  for (std::size_t k = 0; k < first.knot_count(); ++k) {
    for (std::size_t l = 0; l < second.knot_count(); ++l) best.offer(first, second, k, l);
  }
  return result_of(best);
}

std::optional<KnotPair> closest_knots(const PreparedProfile& first, const PreparedProfile& second,
                                      double max_distance_mm) {
  BestPair best = nothing_within(max_distance_mm);
  if (first.tree.box().squared_distance(second.tree.box()) <= best.limit) {
    PairSearch(first, second, best).visit(0, 0);
  }
  return result_of(best);
}

CurvePair refine_on_curves(const CubicCurve& first, const CubicCurve& second,
                           const Isometry& T_second_first, double x, double y) {
  constexpr double kMaxStep = 2.0;     // knots; larger steps are not reliable on a bent curve
  constexpr double kConverged = 1e-2;  // knots; such a small step does not change the distance
  constexpr int kMaxSteps = 8;
  for (int i = 0;; ++i) {
    const CurvePoint p = first.at(x);
    CurvePair pair{x,
                   y,
                   {T_second_first * p.position_mm, T_second_first.linear() * p.derivative_mm},
                   second.at(y),
                   false};
    const Vec3& a = pair.p.derivative_mm;
    const Vec3& b = pair.q.derivative_mm;
    const Vec3 gap = pair.p.position_mm - pair.q.position_mm;
    const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
    const double det = aa * bb - ab * ab;
    if (!(det > 1e-9 * aa * bb)) return pair;  // parallel: no crossing
    const double to_x = (ab * b.dot(gap) - bb * a.dot(gap)) / det;
    const double to_y = (aa * b.dot(gap) - ab * a.dot(gap)) / det;
    const bool settled = std::abs(to_x) < kConverged && std::abs(to_y) < kConverged;
    pair.inside = settled && x > 0.0 && y > 0.0 && x < first.end() && y < second.end();
    const double next_x = std::clamp(x + std::clamp(to_x, -kMaxStep, kMaxStep), 0.0, first.end());
    const double next_y = std::clamp(y + std::clamp(to_y, -kMaxStep, kMaxStep), 0.0, second.end());
    const bool held_at_ends = next_x == x && next_y == y;
    if (settled || held_at_ends || i == kMaxSteps) return pair;
    x = next_x;
    y = next_y;
  }
}

}  // namespace flytri::registration
