#include "core/meshing/surface_nets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace flytri::meshing {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
/// Cells below the lowest point: more than the surface extends beyond the points.
constexpr int kMargin = 64;
/// Steps that move a vertex onto the surface; after the second step, the error is far below the
/// noise.
constexpr int kProjections = 3;
constexpr std::size_t kGrain = 256;

/// Shares of time: of all waves; of a wave in the remaining time (the number of waves is unknown,
/// but the first takes most of the time); of the corners in a wave.
constexpr double kWavesShare = 0.9, kWaveShare = 0.75, kCornerShare = 0.5;

/// A grid position as one number that sorts by z, then y, then x.
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

/// One step along an axis.
constexpr Key step_along(int axis) { return Key{1} << (axis * kBits); }

void sort_unique(std::vector<Key>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// The keys shifted by `low` to `high` steps along an axis. Input and output are sorted. Shifting
/// keeps the order, so merging is enough.
std::vector<Key> dilated(const std::vector<Key>& keys, int axis, int low, int high) {
  const Key step = step_along(axis);
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

/// Looks up rising keys in a sorted list. Each search starts at the previous result, so near keys
/// are found fast.
class Cursor {
 public:
  explicit Cursor(const std::vector<Key>& keys) : keys_(keys) {}

  /// Position of the key in the list, or kNoVertex.
  std::uint32_t find(Key key) {
    std::size_t step = 1;
    if (at_ >= keys_.size() || keys_[at_] > key) at_ = 0;
    while (at_ + step < keys_.size() && keys_[at_ + step] < key) {
      at_ += step;
      step *= 2;
    }
    const auto begin = keys_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto end =
        keys_.begin() + static_cast<std::ptrdiff_t>(std::min(at_ + step + 1, keys_.size()));
    at_ = static_cast<std::size_t>(std::lower_bound(begin, end, key) - keys_.begin());
    return at_ < keys_.size() && keys_[at_] == key ? static_cast<std::uint32_t>(at_) : kNoVertex;
  }

 private:
  const std::vector<Key>& keys_;
  std::size_t at_ = 0;
};

/// Merges new keys and values into the existing ones. Both lists are sorted and have no common key.
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

/// Corner k of a cell is at (k & 1, k >> 1 & 1, k >> 2).
Place corner_of(const Place& cell, int k) {
  return {cell.x + (k & 1), cell.y + (k >> 1 & 1), cell.z + (k >> 2)};
}

/// Reads the values at the corners of cells in rising order. All corners must exist.
class CornerReader {
 public:
  /// Keeps references to both.
  CornerReader(const std::vector<Key>& corners, const std::vector<float>& values)
      : rows_{Cursor(corners), Cursor(corners), Cursor(corners), Cursor(corners)},
        values_(values) {}

  /// The values by corner of the cell, see corner_of.
  std::array<float, 8> around(Key cell) {
    std::array<float, 8> values{};
    for (std::size_t row = 0; row < 4; ++row) {
      const Key first = cell + (row & 1U) * step_along(1) + (row >> 1U) * step_along(2);
      const std::uint32_t at = rows_[row].find(first);
      // The next corner along x is the next in the list.
      values[2 * row] = values_[at];
      values[2 * row + 1] = values_[at + 1];
    }
    return values;
  }

 private:
  std::array<Cursor, 4> rows_;  ///< one per edge along x
  const std::vector<float>& values_;
};

/// Finds end corners and cells of the edges at a corner, by axis, for corners in rising order.
struct EdgeCursors {
  EdgeCursors(const std::vector<Key>& corners, const std::vector<Key>& grid_cells)
      : end(3, Cursor(corners)), cells(3, std::vector(4, Cursor(grid_cells))) {}

  std::vector<Cursor> end;                 ///< end corner of the edge
  std::vector<std::vector<Cursor>> cells;  ///< the four cells around the edge
};

/// One run: the grid, its values and vertices. The grid starts at the points and grows along the
/// surface as long as points surround it.
class Extraction {
 public:
  Extraction(const ImplicitSurface& surface, float spacing_mm, const Workers& workers,
             const Progress& progress)
      : surface_(surface), spacing_mm_(spacing_mm), workers_(workers), progress_(progress) {}

  Result<TriangleMesh> run(const PointCloud& points);

 private:
  [[nodiscard]] std::vector<Key> cells_with_points(const PointCloud& points);
  [[nodiscard]] bool evaluate_corners(const std::vector<Key>& new_cells, const Progress& progress);
  [[nodiscard]] Result<std::vector<Key>> place_vertices(const std::vector<Key>& new_cells,
                                                        const Progress& progress);
  void number_vertices();
  [[nodiscard]] bool connect(const Progress& progress);
  void connect_edge(std::size_t corner, int axis, EdgeCursors& cursors);
  [[nodiscard]] Vec3f position_of(const Place& corner) const {
    return origin_mm_ + spacing_mm_ * Vec3f(static_cast<float>(corner.x),
                                            static_cast<float>(corner.y),
                                            static_cast<float>(corner.z));
  }
  [[nodiscard]] std::optional<SurfacePoint> vertex_in(const Place& cell,
                                                      const std::array<float, 8>& value) const;

  const ImplicitSurface& surface_;
  float spacing_mm_;
  const Workers& workers_;
  const Progress& progress_;
  Vec3f origin_mm_ = Vec3f::Zero();
  std::vector<Key> cells_, corners_;                   ///< sorted
  std::vector<std::optional<SurfacePoint>> vertices_;  ///< by cell
  std::vector<float> values_;                          ///< by corner; NaN: no estimate
  std::vector<std::uint32_t> vertex_of_cell_;          ///< by cell
  TriangleMesh mesh_;
};

Result<TriangleMesh> Extraction::run(const PointCloud& points) {
  std::vector<Key> wave = cells_with_points(points);
  double rest = kWavesShare;
  for (; !wave.empty(); rest *= 1.0 - kWaveShare) {
    const Progress of_wave = progress_.part(kWaveShare * rest);
    if (!evaluate_corners(wave, of_wave.part(kCornerShare))) return stopped();
    auto next = place_vertices(wave, of_wave.part(1.0 - kCornerShare));
    if (!next) return tl::unexpected(next.error());
    wave = std::move(*next);
  }
  progress_.advance(rest);
  number_vertices();
  if (!connect(progress_.part(1.0 - kWavesShare))) return stopped();
  return std::move(mesh_);
}

std::vector<Key> Extraction::cells_with_points(const PointCloud& points) {
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
  return cells;
}

/// @returns false if canceled
bool Extraction::evaluate_corners(const std::vector<Key>& new_cells, const Progress& progress) {
  std::vector<Key> around = new_cells;
  for (int axis = 0; axis < 3; ++axis) around = dilated(around, axis, 0, 1);
  std::vector<Key> corners;
  std::set_difference(around.begin(), around.end(), corners_.begin(), corners_.end(),
                      std::back_inserter(corners));
  std::vector<float> values(corners.size());
  const bool complete = workers_.for_each_unless_cancelled(
      corners.size(),
      [&](std::size_t i) {
        const auto estimate = surface_.at(position_of(place_of(corners[i])));
        values[i] = estimate ? estimate->distance_mm : kNoValue;
      },
      progress, kGrain);
  if (!complete) return false;
  merge(corners, std::move(values), corners_, values_);
  return true;
}

/// Adds the neighbors of a cell at the faces that the surface crosses.
void add_crossed_neighbors(Key cell, const std::array<float, 8>& value,
                           std::vector<Key>& neighbors) {
  for (int axis = 0; axis < 3; ++axis) {
    const Key step = step_along(axis);
    for (const int side : {0, 1}) {
      int outside = 0;
      for (int k = 0; k < 8; ++k) {
        if ((k >> axis & 1) == side && value[k] >= 0.0F) ++outside;
      }
      if (outside != 0 && outside != 4) neighbors.push_back(side == 1 ? cell + step : cell - step);
    }
  }
}

/// @returns the new cells into which the surface continues.
Result<std::vector<Key>> Extraction::place_vertices(const std::vector<Key>& new_cells,
                                                    const Progress& progress) {
  std::vector<std::optional<SurfacePoint>> vertices(new_cells.size());
  const auto place_block = [&](std::size_t block) {
    CornerReader corners(corners_, values_);
    const std::size_t end = std::min(new_cells.size(), (block + 1) * kGrain);
    for (std::size_t i = block * kGrain; i < end; ++i) {
      vertices[i] = vertex_in(place_of(new_cells[i]), corners.around(new_cells[i]));
    }
  };
  const std::size_t blocks = (new_cells.size() + kGrain - 1) / kGrain;
  if (!workers_.for_each_unless_cancelled(blocks, place_block, progress)) return stopped();
  std::vector<Key> neighbors, next;
  CornerReader corners(corners_, values_);
  for (std::size_t i = 0; i < new_cells.size(); ++i) {
    if (!vertices[i]) continue;
    add_crossed_neighbors(new_cells[i], corners.around(new_cells[i]), neighbors);
  }
  merge(new_cells, std::move(vertices), cells_, vertices_);
  sort_unique(neighbors);
  std::set_difference(neighbors.begin(), neighbors.end(), cells_.begin(), cells_.end(),
                      std::back_inserter(next));
  return next;
}

std::optional<SurfacePoint> Extraction::vertex_in(const Place& cell,
                                                  const std::array<float, 8>& value) const {
  bool any_outside = false;
  bool any_inside = false;
  for (int k = 0; k < 8; ++k) {
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
  // A vertex far away from its cell belongs to another sheet of the surface.
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
    vertex_of_cell_[i] = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(*vertices_[i]);
  }
}

void Extraction::connect_edge(std::size_t corner, int axis, EdgeCursors& cursors) {
  const std::uint32_t end = cursors.end[axis].find(corners_[corner] + step_along(axis));
  if (end == kNoVertex) return;
  const bool a_outside = values_[corner] >= 0.0F;
  if (std::isnan(values_[corner]) || std::isnan(values_[end]) ||
      a_outside == (values_[end] >= 0.0F)) {
    return;
  }
  // The four cells around the edge, counter-clockwise seen from its end.
  const Key p = step_along((axis + 1) % 3);
  const Key q = step_along((axis + 2) % 3);
  const Key last = corners_[corner];
  const std::array<Key, 4> around = {last - p - q, last - q, last, last - p};
  std::array<std::uint32_t, 4> ring{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint32_t at = cursors.cells[axis][i].find(around[i]);
    if (at == kNoVertex || vertex_of_cell_[at] == kNoVertex) return;
    ring[i] = vertex_of_cell_[at];
  }
  // The value rises outwards.
  if (a_outside) std::swap(ring[1], ring[3]);
  const auto length2 = [&](int i, int j) {
    return (mesh_.vertices[ring[i]].position_mm - mesh_.vertices[ring[j]].position_mm)
        .squaredNorm();
  };
  // The shorter diagonal gives the rounder triangles.
  if (length2(0, 2) <= length2(1, 3)) {
    mesh_.triangles.push_back({ring[0], ring[1], ring[2]});
    mesh_.triangles.push_back({ring[0], ring[2], ring[3]});
  } else {
    mesh_.triangles.push_back({ring[0], ring[1], ring[3]});
    mesh_.triangles.push_back({ring[1], ring[2], ring[3]});
  }
}

/// @returns false if canceled
bool Extraction::connect(const Progress& progress) {
  EdgeCursors cursors(corners_, cells_);
  const auto connect_corner = [&](std::size_t i) {
    for (int axis = 0; axis < 3; ++axis) connect_edge(i, axis, cursors);
  };
  return for_each_in_order(corners_.size(), connect_corner, progress, kGrain);
}

}  // namespace

Result<TriangleMesh> extract_surface(const ImplicitSurface& surface, const PointCloud& points,
                                     float spacing_mm, const Workers& workers,
                                     const Progress& progress) {
  return Extraction(surface, spacing_mm, workers, progress).run(points);
}

}  // namespace flytri::meshing
