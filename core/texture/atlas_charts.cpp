#include "core/texture/atlas_charts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/meshing/half_edges.h"
#include "core/texture/texel_raster.h"

namespace flytri::texture {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Number of triangles around the first one whose mean normal is the direction of a chart.
constexpr std::size_t kSeedTriangles = 200;

Vec3f area_normal(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3f& a = mesh.vertices[t[0]].position_mm;
  return (mesh.vertices[t[1]].position_mm - a).cross(mesh.vertices[t[2]].position_mm - a);
}

/// The neighbor triangle at each edge of each triangle, or kNone.
std::vector<std::array<std::uint32_t, 3>> find_neighbors(const TriangleMesh& mesh) {
  const std::vector<meshing::HalfEdge> edges = meshing::half_edges_of(mesh);
  std::vector<std::array<std::uint32_t, 3>> neighbors(mesh.triangles.size(), {kNone, kNone, kNone});
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const meshing::HalfEdge& a = edges[i - 1];
    const meshing::HalfEdge& b = edges[i];
    if (!a.same_edge(b)) continue;
    neighbors[a.triangle()][a.corner % 3] = b.triangle();
    neighbors[b.triangle()][b.corner % 3] = a.triangle();
  }
  return neighbors;
}

/// Cuts one chart after the other.
class ChartCutter {
 public:
  ChartCutter(const TriangleMesh& mesh, const ChartOptions& options)
      : mesh_(mesh),
        options_(options),
        neighbors_(find_neighbors(mesh)),
        chart_of_(mesh.triangles.size(), kNone),
        visit_(mesh.triangles.size(), kNone),
        window_px_(std::bit_ceil(static_cast<std::uint32_t>(options.max_chart_px))),
        taken_by_(std::size_t{window_px_} * window_px_, kNone) {}

  Result<std::vector<Chart>> cut(const Progress& progress) {
    std::vector<Chart> charts;
    const auto triangle_count = static_cast<double>(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (chart_of_[t] != kNone) continue;
      if (progress.cancelled()) return stopped();
      charts.push_back(grow(t, static_cast<std::uint32_t>(charts.size())));
      progress.advance(static_cast<double>(charts.back().triangles.size()) / triangle_count);
    }
    return charts;
  }

 private:
  /// Triangles around the seed without a chart, nearest first, about `count`.
  std::vector<std::uint32_t> around(std::uint32_t seed, std::size_t count) {
    std::vector<std::uint32_t> found = {seed};
    visit_[seed] = seed;
    for (std::size_t i = 0; i < found.size() && found.size() < count; ++i) {
      for (const std::uint32_t next : neighbors_[found[i]]) {
        if (next == kNone || chart_of_[next] != kNone || visit_[next] == seed) continue;
        visit_[next] = seed;
        found.push_back(next);
      }
    }
    return found;
  }

  void choose_axes(Chart& chart, std::uint32_t seed) {
    Vec3f normal = Vec3f::Zero();
    for (const std::uint32_t t : around(seed, kSeedTriangles)) {
      normal += area_normal(mesh_, mesh_.triangles[t]);
    }
    const Vec3f own = area_normal(mesh_, mesh_.triangles[seed]).stableNormalized();
    if (normal.stableNormalized().dot(own) < options_.min_cosine) normal = own;
    if (normal.squaredNorm() == 0.0F) normal = Vec3f::UnitZ();
    chart_normal_ = normal.stableNormalized();
    chart.axis_u = chart_normal_.unitOrthogonal();
    chart.axis_v = chart_normal_.cross(chart.axis_u);
  }

  Chart grow(std::uint32_t seed, std::uint32_t number) {
    Chart chart;
    choose_axes(chart, seed);
    low_px_ = Eigen::Array2f::Constant(std::numeric_limits<float>::infinity());
    high_px_ = -low_px_;
    // The seed is always taken, so a degenerate triangle becomes a separate chart.
    std::vector<std::uint32_t> queue = {seed};
    take(chart, seed, number, true);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const std::uint32_t next : neighbors_[queue[i]]) {
        if (next == kNone || chart_of_[next] != kNone) continue;
        if (take(chart, next, number, false)) queue.push_back(next);
      }
    }
    std::sort(chart.triangles.begin(), chart.triangles.end());
    chart.origin_px = low_px_.floor().cast<int>() - options_.gutter_px;
    chart.size_px = high_px_.ceil().cast<int>() + options_.gutter_px - chart.origin_px;
    return chart;
  }

  /// Adds a triangle to the chart unless it faces away, overlaps the chart or makes it too large.
  bool take(Chart& chart, std::uint32_t t, std::uint32_t number, bool always) {
    const Triangle& triangle = mesh_.triangles[t];
    const Vec3f normal = area_normal(mesh_, triangle);
    const float cosine = normal.stableNormalized().dot(chart_normal_);
    if (!always && cosine < static_cast<float>(options_.min_cosine)) return false;
    std::array<Eigen::Array2f, 3> corners;
    Eigen::Array2f low = low_px_;
    Eigen::Array2f high = high_px_;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] =
          project_to_chart(chart, mesh_.vertices[triangle[i]].position_mm, options_.texel_mm);
      low = low.min(corners[i]);
      high = high.max(corners[i]);
    }
    const int room_px = options_.max_chart_px - 2 * options_.gutter_px - 2;
    if (!always && (high - low).maxCoeff() > static_cast<float>(room_px)) return false;
    texels_.clear();
    bool free = true;
    for_each_texel(corners, [&](int x, int y, const Vec3f&) {
      texels_.push_back(place_of(x, y));
      free = free && taken_by_[texels_.back()] != number;
    });
    if (!always && !free) return false;
    for (const std::size_t texel : texels_) taken_by_[texel] = number;
    low_px_ = low;
    high_px_ = high;
    chart_of_[t] = number;
    chart.triangles.push_back(t);
    return true;
  }

  /// Place of a texel in the window. A chart fits into it, so its texels have different places;
  /// only a single triangle may be larger.
  [[nodiscard]] std::size_t place_of(int x, int y) const {
    const auto wrapped = [&](int i) { return static_cast<std::uint32_t>(i) % window_px_; };
    return std::size_t{wrapped(y)} * window_px_ + wrapped(x);
  }

  const TriangleMesh& mesh_;
  const ChartOptions& options_;
  std::vector<std::array<std::uint32_t, 3>> neighbors_;
  std::vector<std::uint32_t> chart_of_;
  std::vector<std::uint32_t> visit_;     ///< the last seed that reached each triangle
  std::uint32_t window_px_;              ///< a power of two
  std::vector<std::uint32_t> taken_by_;  ///< the last chart that took each texel of the window
  std::vector<std::size_t> texels_;      ///< of one triangle
  Vec3f chart_normal_ = Vec3f::UnitZ();
  Eigen::Array2f low_px_ = {0, 0};
  Eigen::Array2f high_px_ = {0, 0};
};

}  // namespace

Eigen::Array2f project_to_chart(const Chart& chart, const Vec3f& position_mm, double texel_mm) {
  return Eigen::Array2f(chart.axis_u.dot(position_mm), chart.axis_v.dot(position_mm)) /
         static_cast<float>(texel_mm);
}

Result<std::vector<Chart>> cut_charts(const TriangleMesh& mesh, const ChartOptions& options,
                                      const Progress& progress) {
  return ChartCutter(mesh, options).cut(progress);
}

bool pack_charts(std::vector<Chart>& charts, int side_px) {
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return charts[a].size_px.y() > charts[b].size_px.y();
  });
  Eigen::Array2i corner(0, 0);
  int shelf_px = 0;
  for (const std::size_t i : order) {
    const Eigen::Array2i& size_px = charts[i].size_px;
    if (corner.x() + size_px.x() > side_px) {
      corner = {0, corner.y() + shelf_px};
      shelf_px = 0;
    }
    if (shelf_px == 0) shelf_px = size_px.y();
    if (size_px.x() > side_px || corner.y() + size_px.y() > side_px) return false;
    charts[i].corner_px = corner;
    corner.x() += size_px.x();
  }
  return true;
}

}  // namespace flytri::texture
