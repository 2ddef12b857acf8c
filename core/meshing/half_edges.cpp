#include "core/meshing/half_edges.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace flytri::meshing {

namespace {

/// A stable sort: by insertion, because most vertices have few edges.
void sort_by_high(std::span<HalfEdge> edges) {
  constexpr std::size_t kFew = 32;
  if (edges.size() > kFew) {
    std::stable_sort(edges.begin(), edges.end(),
                     [](const HalfEdge& a, const HalfEdge& b) { return a.high < b.high; });
    return;
  }
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const HalfEdge edge = edges[i];
    std::size_t place = i;
    for (; place > 0 && edges[place - 1].high > edge.high; --place) edges[place] = edges[place - 1];
    edges[place] = edge;
  }
}

}  // namespace

std::vector<HalfEdge> half_edges_of(const TriangleMesh& mesh) {
  // Bucket sort by the low vertex, then by the high one in each bucket.
  std::vector<std::size_t> starts(mesh.vertices.size() + 1, 0);
  const auto for_each_edge = [&](const auto& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangles[t][k];
        const std::uint32_t b = mesh.triangles[t][(k + 1) % 3];
        visit(HalfEdge{std::min(a, b), std::max(a, b), 3 * t + k, a < b});
      }
    }
  };
  for_each_edge([&](const HalfEdge& edge) { ++starts[edge.low + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<HalfEdge> edges(3 * mesh.triangles.size());
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  for_each_edge([&](const HalfEdge& edge) { edges[next[edge.low]++] = edge; });
  for (std::size_t v = 0; v + 1 < starts.size(); ++v)
    sort_by_high(std::span(edges).subspan(starts[v], starts[v + 1] - starts[v]));
  return edges;
}

}  // namespace flytri::meshing
