#include "core/meshing/surface_nets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace flytri {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
/// Cells below the lowest point: farther than the surface goes beyond the points.
constexpr int kMargin = 64;
/// Steps that move a vertex onto the surface; the second is already far below the noise.
constexpr int kProjections = 3;
constexpr std::size_t kGrain = 256;

/// A grid place as one number that sorts by z, then y, then x.
using Key = std::uint64_t;
constexpr int kBits = 21;
constexpr Key kMask = (Key{1} << kBits) - 1;

struct Place {
  std::int32_t x, y, z;  ///< > 0
};
Key key_of(const Place& p) {
  return (static_cast<Key>(p.z) << (2 * kBits)) | (static_cast<Key>(p.y) << kBits) |
         static_cast<Key>(p.x);
}
Place place_of(Key key) {
  return {static_cast<std::int32_t>(key & kMask), static_cast<std::int32_t>((key >> kBits) & kMask),
          static_cast<std::int32_t>(key >> (2 * kBits))};
}

void sort_unique(std::vector<Key>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// The places `low` to `high` steps along an axis from those given; sorted, as those given are.
/// Shifting keeps the order, so merging takes the place of sorting all of them again.
std::vector<Key> dilated(const std::vector<Key>& keys, int axis, int low, int high) {
  const Key step = Key{1} << (axis * kBits);
  std::vector<Key> result, shifted(keys.size()), merged;
  for (int offset = low; offset <= high; ++offset) {
    const Key shift = static_cast<Key>(offset) * step;  // wraps around where it is negative
    std::transform(keys.begin(), keys.end(), shifted.begin(), [&](Key key) { return key + shift; });
    merged.clear();
    std::set_union(result.begin(), result.end(), shifted.begin(), shifted.end(),
                   std::back_inserter(merged));
    result.swap(merged);
  }
  return result;
}

/// Position of a key in a sorted list, or kNoVertex.
std::uint32_t find(const std::vector<Key>& keys, Key key) {
  const auto it = std::lower_bound(keys.begin(), keys.end(), key);
  return it != keys.end() && *it == key ? static_cast<std::uint32_t>(it - keys.begin()) : kNoVertex;
}

/// Puts new keys with their values among those that are there; both are sorted, none is in both.
template <typename Value>
void merge(const std::vector<Key>& new_keys, std::vector<Value> new_values, std::vector<Key>& keys,
           std::vector<Value>& values) {
  std::vector<Key> all_keys(keys.size() + new_keys.size());
  std::vector<Value> all_values(all_keys.size());
  std::size_t a = 0, b = 0;
  for (std::size_t i = 0; i < all_keys.size(); ++i) {
    const bool take_new = a == keys.size() || (b < new_keys.size() && new_keys[b] < keys[a]);
    all_keys[i] = take_new ? new_keys[b] : keys[a];
    all_values[i] = std::move(take_new ? new_values[b] : values[a]);
    ++(take_new ? b : a);
  }
  keys.swap(all_keys);
  values.swap(all_values);
}

/// Corner k of a cell lies at (k & 1, k >> 1 & 1, k >> 2).
Place corner_of(const Place& cell, int k) {
  return {cell.x + (k & 1), cell.y + (k >> 1 & 1), cell.z + (k >> 2)};
}

/// One run: the grid, its values, its vertices. The grid begins around the points and grows along
/// the surface as long as points surround it.
class Extraction {
 public:
  Extraction(const ImplicitSurface& surface, const PointCloud& points, float spacing_mm,
             const Workers& workers)
      : surface_(surface), spacing_mm_(spacing_mm), workers_(workers) {
    std::vector<Key> wave = cells_around(points);
    while (!wave.empty()) {
      evaluate_corners(wave);
      wave = place_vertices(wave);
    }
    number_vertices();
    connect();
  }
  TriangleMesh mesh;

 private:
  [[nodiscard]] std::vector<Key> cells_around(const PointCloud& points);
  void evaluate_corners(const std::vector<Key>& new_cells);
  [[nodiscard]] std::vector<Key> place_vertices(const std::vector<Key>& new_cells);
  void add_crossed_neighbors(Key cell, std::vector<Key>& neighbors) const;
  void number_vertices();
  void connect();
  void connect_edge(const Place& corner, int axis);
  [[nodiscard]] Vec3f position_of(const Place& corner) const {
    return origin_mm_ + spacing_mm_ * Vec3f(static_cast<float>(corner.x),
                                            static_cast<float>(corner.y),
                                            static_cast<float>(corner.z));
  }
  [[nodiscard]] float value_at(const Place& corner) const {
    return values_[find(corners_, key_of(corner))];
  }
  [[nodiscard]] std::optional<SurfacePoint> vertex_in(const Place& cell) const;

  const ImplicitSurface& surface_;
  float spacing_mm_;
  const Workers& workers_;
  Vec3f origin_mm_ = Vec3f::Zero();
  std::vector<Key> cells_, corners_;                   ///< sorted
  std::vector<std::optional<SurfacePoint>> vertices_;  ///< by cell
  std::vector<float> values_;                          ///< by corner; NaN: no estimate
  std::vector<std::uint32_t> vertex_of_cell_;          ///< by cell
};

std::vector<Key> Extraction::cells_around(const PointCloud& points) {
  Vec3f low = points.front().position_mm;
  for (const SurfacePoint& point : points) low = low.cwiseMin(point.position_mm);
  origin_mm_ = low - Vec3f::Constant(spacing_mm_ * static_cast<float>(kMargin));
  std::vector<Key> cells;
  for (const SurfacePoint& point : points) {
    const Vec3f p = (point.position_mm - origin_mm_) / spacing_mm_;
    cells.push_back(key_of({static_cast<std::int32_t>(p.x()), static_cast<std::int32_t>(p.y()),
                            static_cast<std::int32_t>(p.z())}));
  }
  sort_unique(cells);
  for (int axis = 0; axis < 3; ++axis) cells = dilated(cells, axis, -1, 1);
  return cells;
}

void Extraction::evaluate_corners(const std::vector<Key>& new_cells) {
  std::vector<Key> around = new_cells;
  for (int axis = 0; axis < 3; ++axis) around = dilated(around, axis, 0, 1);
  std::vector<Key> corners;
  std::set_difference(around.begin(), around.end(), corners_.begin(), corners_.end(),
                      std::back_inserter(corners));
  std::vector<float> values(corners.size());
  workers_.for_each(
      corners.size(),
      [&](std::size_t i) {
        const auto estimate = surface_.at(position_of(place_of(corners[i])));
        values[i] = estimate ? estimate->distance_mm : kNoValue;
      },
      kGrain);
  merge(corners, std::move(values), corners_, values_);
}

/// The neighbors of a cell across those faces that the surface crosses.
void Extraction::add_crossed_neighbors(Key cell, std::vector<Key>& neighbors) const {
  const Place place = place_of(cell);
  for (int axis = 0; axis < 3; ++axis) {
    const Key step = Key{1} << (axis * kBits);
    for (const int side : {0, 1}) {
      int outside = 0;
      for (int k = 0; k < 8; ++k) {
        if ((k >> axis & 1) == side && value_at(corner_of(place, k)) >= 0.0F) ++outside;
      }
      if (outside != 0 && outside != 4) neighbors.push_back(side == 1 ? cell + step : cell - step);
    }
  }
}

/// @returns the cells into which the surface goes on, that are not there yet.
std::vector<Key> Extraction::place_vertices(const std::vector<Key>& new_cells) {
  std::vector<std::optional<SurfacePoint>> vertices(new_cells.size());
  workers_.for_each(
      new_cells.size(), [&](std::size_t i) { vertices[i] = vertex_in(place_of(new_cells[i])); },
      kGrain);
  std::vector<Key> neighbors, next;
  for (std::size_t i = 0; i < new_cells.size(); ++i) {
    if (vertices[i]) add_crossed_neighbors(new_cells[i], neighbors);
  }
  merge(new_cells, std::move(vertices), cells_, vertices_);
  sort_unique(neighbors);
  std::set_difference(neighbors.begin(), neighbors.end(), cells_.begin(), cells_.end(),
                      std::back_inserter(next));
  return next;
}

std::optional<SurfacePoint> Extraction::vertex_in(const Place& cell) const {
  std::array<float, 8> value{};
  bool any_outside = false;
  bool any_inside = false;
  for (int k = 0; k < 8; ++k) {
    value[k] = value_at(corner_of(cell, k));
    if (std::isnan(value[k])) return std::nullopt;
    (value[k] >= 0.0F ? any_outside : any_inside) = true;
  }
  if (!any_inside || !any_outside) return std::nullopt;
  Vec3f sum = Vec3f::Zero();
  float count = 0.0F;
  for (int k = 0; k < 8; ++k) {
    for (int bit = 1; bit < 8; bit <<= 1) {
      const int l = k | bit;
      if (l == k || (value[k] >= 0.0F) == (value[l] >= 0.0F)) continue;
      const Vec3f a = position_of(corner_of(cell, k));
      const Vec3f b = position_of(corner_of(cell, l));
      sum += a + value[k] / (value[k] - value[l]) * (b - a);
      count += 1.0F;
    }
  }
  Vec3f place = sum / count;
  std::optional<SurfaceEstimate> estimate;
  for (int i = 0; i < kProjections; ++i) {
    estimate = surface_.at(place);
    if (!estimate) return std::nullopt;
    place -= estimate->distance_mm * estimate->mean.normal;
  }
  // A vertex that leaves its cell's neighborhood follows another sheet.
  if ((place - sum / count).norm() > spacing_mm_) return std::nullopt;
  if (!surface_.surrounded(place, estimate->mean.normal)) return std::nullopt;
  SurfacePoint vertex = estimate->mean;
  vertex.position_mm = place;
  return vertex;
}

void Extraction::number_vertices() {
  vertex_of_cell_.assign(cells_.size(), kNoVertex);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!vertices_[i]) continue;
    vertex_of_cell_[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(*vertices_[i]);
  }
}

void Extraction::connect_edge(const Place& corner, int axis) {
  std::array<std::int32_t, 3> end = {corner.x, corner.y, corner.z};
  ++end[axis];
  const std::uint32_t a = find(corners_, key_of(corner));
  const std::uint32_t b = find(corners_, key_of({end[0], end[1], end[2]}));
  if (b == kNoVertex) return;
  const bool a_outside = values_[a] >= 0.0F;
  if (std::isnan(values_[a]) || std::isnan(values_[b]) || a_outside == (values_[b] >= 0.0F)) return;
  // The four cells around the edge, counter-clockwise seen from its end.
  const int p = (axis + 1) % 3;
  const int q = (axis + 2) % 3;
  constexpr std::array<std::array<int, 2>, 4> kAround = {{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
  std::array<std::uint32_t, 4> ring{};
  for (int i = 0; i < 4; ++i) {
    std::array<std::int32_t, 3> cell = {corner.x, corner.y, corner.z};
    cell[p] += kAround[i][0];
    cell[q] += kAround[i][1];
    const std::uint32_t at = find(cells_, key_of({cell[0], cell[1], cell[2]}));
    if (at == kNoVertex || vertex_of_cell_[at] == kNoVertex) return;
    ring[i] = vertex_of_cell_[at];
  }
  // Outwards is where the value rises.
  if (a_outside) std::swap(ring[1], ring[3]);
  const auto length2 = [&](int i, int j) {
    return (mesh.vertices[ring[i]].position_mm - mesh.vertices[ring[j]].position_mm).squaredNorm();
  };
  // The shorter diagonal gives the rounder triangles.
  if (length2(0, 2) <= length2(1, 3)) {
    mesh.triangles.push_back({ring[0], ring[1], ring[2]});
    mesh.triangles.push_back({ring[0], ring[2], ring[3]});
  } else {
    mesh.triangles.push_back({ring[0], ring[1], ring[3]});
    mesh.triangles.push_back({ring[1], ring[2], ring[3]});
  }
}

void Extraction::connect() {
  for (const Key key : corners_) {
    for (int axis = 0; axis < 3; ++axis) connect_edge(place_of(key), axis);
  }
}

}  // namespace

TriangleMesh extract_surface(const ImplicitSurface& surface, const PointCloud& points,
                             float spacing_mm, const Workers& workers) {
  return std::move(Extraction(surface, points, spacing_mm, workers).mesh);
}

}  // namespace flytri
