#include "core/calibration/fit/number_dots.h"

#include <cmath>
#include <deque>
#include <optional>

#include "core/base/median.h"
#include "core/geometry/rigid.h"

namespace flytri::calibration {
namespace {

/// Largest distance of a dot from its expected position, as a share of the pitch.
constexpr double kTolerance = 0.25;

Vec2 position(const Dot& dot) { return {dot.center.u_px, dot.center.v_px}; }

double median_area(const std::vector<Dot>& dots) {
  std::vector<double> areas;
  areas.reserve(dots.size());
  for (const Dot& dot : dots) areas.push_back(dot.area_px);
  return median_of(areas);
}

/// The dots (0, 0), (1, 0), (0, 2), as indices.
struct Markers {
  std::size_t origin, right, below;
};

/// Deviation of three points from the marker pattern, in units of the short side.
double marker_misfit(const Vec2& origin, const Vec2& right, const Vec2& below) {
  const Vec2 x = right - origin;
  const Vec2 y = 0.5 * (below - origin);
  return (y - Vec2(-x.y(), x.x())).norm() / x.norm();  // u right, v down: a rotation by 90 degrees
                                                       // is (-v, u)
}

Result<Markers> find_markers(const std::vector<Dot>& dots, const DotTarget& target) {
  const double ratio = std::pow(target.marker_diameter_mm / target.diameter_mm, 2);
  const double large_area = std::sqrt(ratio) * median_area(dots);  // between the areas of small and
                                                                   // large dots
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (dots[i].area_px > large_area) large.push_back(i);
  }
  std::optional<Markers> best;
  double best_misfit = 0.5;
  for (const std::size_t a : large) {
    for (const std::size_t b : large) {
      for (const std::size_t c : large) {
        if (a == b || a == c || b == c) continue;
        const double misfit =
            marker_misfit(position(dots[a]), position(dots[b]), position(dots[c]));
        if (misfit < best_misfit) {
          best_misfit = misfit;
          best = Markers{a, b, c};
        }
      }
    }
  }
  if (!best) {
    return fail(ErrorCode::kInconsistent,
                "cannot find the three large dots (0, 0), (1, 0) and (0, 2) among {} dots, {} of "
                "them large; uncover them",
                dots.size(), large.size());
  }
  return *best;
}

/// A numbered dot with the local grid steps.
struct Node {
  std::size_t dot;
  int i, j;
  Vec2 step_i, step_j;  ///< px from this dot to its neighbors
};

class GridWalk {
 public:
  explicit GridWalk(const std::vector<Dot>& dots) : dots_(dots), taken_(dots.size(), false) {}

  std::vector<Node> walk(const Markers& markers) {
    const Vec2 origin = position(dots_[markers.origin]);
    add({markers.origin, 0, 0, position(dots_[markers.right]) - origin,
         0.5 * (position(dots_[markers.below]) - origin)});
    while (!queue_.empty()) {
      const Node node = queue_.front();
      queue_.pop_front();
      visit(node, 1, 0);
      visit(node, -1, 0);
      visit(node, 0, 1);
      visit(node, 0, -1);
    }
    return std::move(nodes_);
  }

 private:
  void add(const Node& node) {
    taken_[node.dot] = true;
    nodes_.push_back(node);
    queue_.push_back(node);
  }

  /// Searches the neighbor one step along i or j, and updates the step.
  void visit(const Node& from, int di, int dj) {
    const Vec2 step = di * from.step_i + dj * from.step_j;
    const Vec2 here = position(dots_[from.dot]);
    const auto next = nearest(here + step, kTolerance * step.norm());
    if (!next || taken_[*next]) return;
    Node node{*next, from.i + di, from.j + dj, from.step_i, from.step_j};
    const Vec2 found = position(dots_[*next]) - here;
    (di != 0 ? node.step_i : node.step_j) = (di + dj) * found;
    add(node);
  }

  [[nodiscard]] std::optional<std::size_t> nearest(const Vec2& at, double radius) const {
    std::optional<std::size_t> best;
    double best_distance = radius;
    for (std::size_t i = 0; i < dots_.size(); ++i) {
      const double distance = (position(dots_[i]) - at).norm();
      if (distance < best_distance) {
        best_distance = distance;
        best = i;
      }
    }
    return best;
  }

  const std::vector<Dot>& dots_;
  std::vector<bool> taken_;
  std::vector<Node> nodes_;
  std::deque<Node> queue_;
};

}  // namespace

Result<std::vector<NumberedDot>> number_dots(const std::vector<Dot>& dots,
                                             const DotTarget& target) {
  if (dots.size() < 4) {
    return fail(ErrorCode::kInsufficient, "only {} dots found; the image must show the dot target",
                dots.size());
  }
  const auto markers = find_markers(dots, target);
  if (!markers) return tl::unexpected(markers.error());
  std::vector<NumberedDot> numbered;
  for (const Node& node : GridWalk(dots).walk(*markers)) {
    const bool marker =
        node.dot == markers->origin || node.dot == markers->right || node.dot == markers->below;
    if (!marker) numbered.push_back({node.i, node.j, dots[node.dot].center});
  }
  return numbered;
}

}  // namespace flytri::calibration
