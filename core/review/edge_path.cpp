#include "core/review/edge_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/meshing/half_edges.h"
#include "core/review/bending.h"

namespace flytri::review {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// The neighbors of each vertex.
class VertexGraph {
 public:
  explicit VertexGraph(const TriangleMesh& mesh) : starts_(mesh.vertices.size() + 1, 0) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const meshing::HalfEdge& edge : meshing::half_edges_of(mesh)) {
      const std::pair<std::uint32_t, std::uint32_t> ends(edge.low, edge.high);
      if (edge.low != edge.high && (edges.empty() || edges.back() != ends)) edges.push_back(ends);
    }
    for (const auto& [low, high] : edges) ++starts_[low + 1], ++starts_[high + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    neighbors_.resize(starts_.back());
    std::vector<std::uint32_t> at(starts_.begin(), starts_.end() - 1);
    for (const auto& [low, high] : edges) {
      neighbors_[at[low]++] = high;
      neighbors_[at[high]++] = low;
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> neighbors(std::uint32_t vertex) const {
    return std::span(neighbors_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
  }

 private:
  std::vector<std::uint32_t> starts_, neighbors_;
};

/// Searches ways over a mesh that prefer edges.
class EdgeSearch {
 public:
  EdgeSearch(const TriangleMesh& mesh, const EdgePathOptions& options)
      : mesh_(mesh),
        options_(options),
        graph_(mesh),
        bending_(mesh, options.bending_mm),
        cost_(mesh.vertices.size(), kFar),
        before_(mesh.vertices.size(), kNoVertex) {}

  /// The sharpest vertex near a click; nearer ones are preferred.
  [[nodiscard]] std::optional<std::uint32_t> snap(const Vec3& click_mm) {
    std::vector<Neighbor> found;
    bending_.near(click_mm, options_.snap_mm, found);
    std::sort(found.begin(), found.end(),
              [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; });
    std::optional<std::uint32_t> best;
    double best_score = 0.0;
    for (const Neighbor& vertex : found) {
      const double bent = bending_.convexity(vertex.index);
      const double share = std::sqrt(vertex.distance2_mm2) / options_.snap_mm;
      const double score = bent * (1.0 - 0.5 * share);
      if (bent < options_.least_bending_per_mm || score <= best_score) continue;
      best = vertex.index;
      best_score = score;
    }
    return best;
  }

  /// Bending that counts as fully sharp.
  void set_sharp(const std::vector<std::uint32_t>& on_edge) {
    std::vector<double> bent;
    bent.reserve(on_edge.size());
    for (const std::uint32_t vertex : on_edge) bent.push_back(bending_.convexity(vertex));
    sharp_per_mm_ = median_of(bent);
  }

  /// The vertices after `from` up to `to`; empty if there is no way.
  [[nodiscard]] std::vector<std::uint32_t> way(std::uint32_t from, std::uint32_t to) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::vector<std::uint32_t> seen = {from};
    cost_[from] = 0.0;
    open.push({0.0, from});
    while (!open.empty() && open.top().second != to) {
      const auto [cost, at] = open.top();
      open.pop();
      if (cost > cost_[at]) continue;
      for (const std::uint32_t next : graph_.neighbors(at)) {
        const double reached = cost + step_cost(at, next);
        if (reached >= cost_[next]) continue;
        if (cost_[next] == kFar) seen.push_back(next);
        cost_[next] = reached;
        before_[next] = at;
        open.push({reached, next});
      }
    }
    std::vector<std::uint32_t> way;
    if (!open.empty()) {
      for (std::uint32_t at = to; at != from; at = before_[at]) way.push_back(at);
      std::reverse(way.begin(), way.end());
    }
    for (const std::uint32_t vertex : seen) cost_[vertex] = kFar;
    return way;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  [[nodiscard]] double step_cost(std::uint32_t a, std::uint32_t b) {
    const double length_mm = (mesh_.vertices[a].position_mm - mesh_.vertices[b].position_mm).norm();
    const double bent = 0.5 * (bending_.convexity(a) + bending_.convexity(b));
    const double share = std::min(1.0, bent / sharp_per_mm_);
    return length_mm * options_.edge_cost / (options_.edge_cost + share * share);
  }

  const TriangleMesh& mesh_;
  const EdgePathOptions& options_;
  VertexGraph graph_;
  Bending bending_;
  double sharp_per_mm_ = 1.0;
  std::vector<double> cost_;
  std::vector<std::uint32_t> before_;
};

/// Drops ways that lead back on themselves.
void drop_spurs(std::vector<std::uint32_t>& path) {
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t vertex : path) {
    if (kept.size() >= 2 && kept[kept.size() - 2] == vertex) {
      kept.pop_back();
    } else if (kept.empty() || kept.back() != vertex) {
      kept.push_back(vertex);
    }
  }
  while (kept.size() >= 3 && (kept.front() == kept.back() || kept[1] == kept.back())) {
    if (kept[1] == kept.back()) kept.erase(kept.begin());
    if (kept.front() == kept.back()) kept.pop_back();
  }
  path = std::move(kept);
}

std::string place_words(const Vec3& p_mm) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) mm", p_mm.x(), p_mm.y(), p_mm.z());
}

Result<std::vector<std::uint32_t>> snap_all(EdgeSearch& search, std::span<const Vec3> clicks_mm,
                                            const EdgePathOptions& options) {
  std::vector<std::uint32_t> on_edge;
  for (const Vec3& click_mm : clicks_mm) {
    const auto vertex = search.snap(click_mm);
    if (!vertex)
      return fail(ErrorCode::kInsufficient,
                  "the surface has no edge within {} mm of the point {}; choose a point nearer to "
                  "the margin",
                  options.snap_mm, place_words(click_mm));
    on_edge.push_back(*vertex);
  }
  return on_edge;
}

}  // namespace

Result<void> EdgePathOptions::validate() const {
  return OptionCheck("EdgePathOptions")
      .positive("bending_mm", bending_mm)
      .positive("snap_mm", snap_mm)
      .positive("least_bending_per_mm", least_bending_per_mm)
      .positive_up_to("edge_cost", edge_cost, 1.0)
      .result();
}

Result<std::vector<std::uint32_t>> edge_path(const TriangleMesh& mesh,
                                             std::span<const Vec3> clicks_mm,
                                             const EdgePathOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (clicks_mm.size() < 3)
    return fail(ErrorCode::kBadOption,
                "a margin line needs three points or more, but has {}; choose more along the edge",
                clicks_mm.size());
  EdgeSearch search(mesh, options);
  const auto on_edge = snap_all(search, clicks_mm, options);
  if (!on_edge) return tl::unexpected(on_edge.error());
  search.set_sharp(*on_edge);
  std::vector<std::uint32_t> path;
  for (std::size_t i = 0; i < on_edge->size(); ++i) {
    const std::size_t next = (i + 1) % on_edge->size();
    if ((*on_edge)[i] == (*on_edge)[next])
      return fail(ErrorCode::kInconsistent,
                  "the points {} and {} lie at the same place of the edge; leave one out",
                  place_words(clicks_mm[i]), place_words(clicks_mm[next]));
    const std::vector<std::uint32_t> way = search.way((*on_edge)[i], (*on_edge)[next]);
    if (way.empty())
      return fail(ErrorCode::kInconsistent,
                  "no way over the surface leads from {} to {}; choose points on one tooth",
                  place_words(clicks_mm[i]), place_words(clicks_mm[next]));
    path.insert(path.end(), way.begin(), way.end());
  }
  drop_spurs(path);
  std::vector<std::uint32_t> sorted = path;
  std::sort(sorted.begin(), sorted.end());
  if (path.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    return fail(ErrorCode::kInconsistent,
                "the line through the points comes back on itself; give them in order along the "
                "edge, or more of them");
  return path;
}

}  // namespace flytri::review
