#include "core/meshing/surface_nets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/geometry/surface_net.h"

namespace flytri::meshing {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
/// Steps that move a vertex onto the surface; after the second step, the error is far below the
/// noise.
constexpr int kProjections = 3;
constexpr std::uint32_t kNotPlaced = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kGrain = 256;
std::size_t block_count(std::size_t count) { return (count + kGrain - 1) / kGrain; }

/// Shares of time: of all waves; of a wave in the remaining time (the number of waves is unknown,
/// but the first takes most of the time); of the corners in a wave.
constexpr double kWavesShare = 0.9, kWaveShare = 0.75, kCornerShare = 0.5;

/// The keys shifted by `low` to `high` steps along an axis. Input and output are sorted. Shifting
/// keeps the order, so merging is enough.
std::vector<CellKey> dilated(const std::vector<CellKey>& keys, int axis, int low, int high) {
  std::vector<CellKey> result, shifted(keys.size()), merged;
  for (int offset = low; offset <= high; ++offset) {
    std::transform(keys.begin(), keys.end(), shifted.begin(),
                   [&](CellKey key) { return grid_step(key, axis, offset); });
    merged.clear();
    std::set_union(result.begin(), result.end(), shifted.begin(), shifted.end(),
                   std::back_inserter(merged));
    result.swap(merged);
  }
  return result;
}

/// Merges new keys and values into the existing ones. Both lists are sorted and have no common key.
template <typename Value>
void merge(const std::vector<CellKey>& new_keys, const std::vector<Value>& new_values,
           std::vector<CellKey>& keys, std::vector<Value>& values) {
  std::vector<CellKey> all_keys(keys.size() + new_keys.size());
  std::vector<Value> all_values(all_keys.size());
  std::size_t a = 0, b = 0;
  for (std::size_t i = 0; i < all_keys.size(); ++i) {
    const bool take_new = a == keys.size() || (b < new_keys.size() && new_keys[b] < keys[a]);
    all_keys[i] = take_new ? new_keys[b] : keys[a];
    all_values[i] = take_new ? new_values[b] : values[a];
    ++(take_new ? b : a);
  }
  keys.swap(all_keys);
  values.swap(all_values);
}

/// One run: the grid, its values and vertices. The grid starts at the points and grows along the
/// surface as long as points surround it.
class Extraction {
 public:
  Extraction(const ImplicitSurface& surface, float spacing_mm, const Workers& workers,
             const Progress& progress)
      : surface_(surface), spacing_mm_(spacing_mm), workers_(workers), progress_(progress) {}

  Result<TriangleMesh> run(const PointCloud& points);

 private:
  [[nodiscard]] std::vector<CellKey> cells_with_points(const PointCloud& points);
  template <typename Work>
  [[nodiscard]] bool for_each_block(std::size_t count, const Work& work,
                                    const Progress& progress) const;
  [[nodiscard]] bool evaluate_corners(const std::vector<CellKey>& new_cells,
                                      const Progress& progress);
  [[nodiscard]] Result<std::vector<CellKey>> place_vertices(const std::vector<CellKey>& new_cells,
                                                            const Progress& progress);
  void number_vertices();
  [[nodiscard]] bool connect(const Progress& progress);
  void add_quad(const std::array<std::uint32_t, 4>& ring, std::vector<Triangle>& triangles) const;
  [[nodiscard]] Vec3f position_of(CellKey corner) const {
    return spacing_mm_ * Vec3f(static_cast<float>(grid_number(corner, 0)),
                               static_cast<float>(grid_number(corner, 1)),
                               static_cast<float>(grid_number(corner, 2)));
  }
  [[nodiscard]] std::optional<SurfacePoint> vertex_in(CellKey cell,
                                                      const std::array<float, 8>& value,
                                                      SurfaceProbe& probe) const;

  const ImplicitSurface& surface_;
  float spacing_mm_;
  const Workers& workers_;
  const Progress& progress_;
  CornerValues grid_;                  ///< NaN: no estimate
  std::vector<CellKey> cells_;         ///< sorted
  std::vector<std::uint32_t> places_;  ///< of their vertices in placed_, or kNotPlaced
  std::vector<SurfacePoint> placed_;   ///< vertices, wave by wave
  std::vector<CellKey> net_cells_;     ///< those with a vertex
  TriangleMesh mesh_;
};

Result<TriangleMesh> Extraction::run(const PointCloud& points) {
  std::vector<CellKey> wave = cells_with_points(points);
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

std::vector<CellKey> Extraction::cells_with_points(const PointCloud& points) {
  std::vector<CellKey> cells;
  cells.reserve(points.size());
  for (const SurfacePoint& point : points) {
    const Vec3f p = point.position_mm / spacing_mm_;
    cells.push_back(
        grid_key(CellKey::number(p.x()), CellKey::number(p.y()), CellKey::number(p.z())));
  }
  sort_unique(cells);
  return cells;
}

/// Calls work(begin, end) for blocks of [0, count), in parallel.
/// @returns false if canceled
template <typename Work>
bool Extraction::for_each_block(std::size_t count, const Work& work,
                                const Progress& progress) const {
  const auto block = [&](std::size_t i) { work(i * kGrain, std::min(count, (i + 1) * kGrain)); };
  return workers_.for_each_unless_cancelled(block_count(count), block, progress);
}

/// @returns false if canceled
bool Extraction::evaluate_corners(const std::vector<CellKey>& new_cells, const Progress& progress) {
  std::vector<CellKey> around = new_cells;
  for (int axis = 0; axis < 3; ++axis) around = dilated(around, axis, 0, 1);
  std::vector<CellKey> corners;
  std::set_difference(around.begin(), around.end(), grid_.corners.begin(), grid_.corners.end(),
                      std::back_inserter(corners));
  std::vector<float> values(corners.size());
  const auto evaluate = [&](std::size_t begin, std::size_t end) {
    SurfaceProbe probe(surface_);
    for (std::size_t i = begin; i < end; ++i)
      values[i] = probe.distance_mm(position_of(corners[i])).value_or(kNoValue);
  };
  if (!for_each_block(corners.size(), evaluate, progress)) return false;
  merge(corners, values, grid_.corners, grid_.values);
  return true;
}

/// Adds the neighbors of a cell at the faces that the surface crosses.
void add_crossed_neighbors(CellKey cell, const std::array<float, 8>& value,
                           std::vector<CellKey>& neighbors) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      int outside = 0;
      for (int k = 0; k < 8; ++k) {
        if ((k >> axis & 1) == side && value[k] >= 0.0F) ++outside;
      }
      if (outside != 0 && outside != 4) {
        neighbors.push_back(grid_step(cell, axis, side == 1 ? 1 : -1));
      }
    }
  }
}

/// @returns the new cells into which the surface continues.
Result<std::vector<CellKey>> Extraction::place_vertices(const std::vector<CellKey>& new_cells,
                                                        const Progress& progress) {
  std::vector<std::optional<SurfacePoint>> vertices(new_cells.size());
  std::vector<std::vector<CellKey>> crossed(block_count(new_cells.size()));
  const auto place = [&](std::size_t begin, std::size_t end) {
    CornerReader corners(grid_);
    SurfaceProbe probe(surface_);
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<float, 8> value = corners.around(new_cells[i]);
      vertices[i] = vertex_in(new_cells[i], value, probe);
      if (vertices[i]) add_crossed_neighbors(new_cells[i], value, crossed[begin / kGrain]);
    }
  };
  if (!for_each_block(new_cells.size(), place, progress)) return stopped();
  std::vector<std::uint32_t> places(new_cells.size(), kNotPlaced);
  for (std::size_t i = 0; i < new_cells.size(); ++i) {
    if (!vertices[i]) continue;
    places[i] = static_cast<std::uint32_t>(placed_.size());
    placed_.push_back(*vertices[i]);
  }
  merge(new_cells, places, cells_, places_);
  std::vector<CellKey> neighbors, next;
  for (const std::vector<CellKey>& of_block : crossed) {
    neighbors.insert(neighbors.end(), of_block.begin(), of_block.end());
  }
  sort_unique(neighbors);
  std::set_difference(neighbors.begin(), neighbors.end(), cells_.begin(), cells_.end(),
                      std::back_inserter(next));
  return next;
}

std::optional<SurfacePoint> Extraction::vertex_in(CellKey cell, const std::array<float, 8>& value,
                                                  SurfaceProbe& probe) const {
  if (!is_crossed(value)) return std::nullopt;
  Vec3f sum = Vec3f::Zero();
  float count = 0.0F;
  for_each_crossing(value, [&](int k, int l, double share) {
    const Vec3f a = position_of(corner_of(cell, k));
    const Vec3f b = position_of(corner_of(cell, l));
    sum += a + static_cast<float>(share) * (b - a);
    count += 1.0F;
  });
  Vec3f place = sum / count;
  for (int i = 1; i < kProjections; ++i) {
    const std::optional<Vec3f> offset_mm = probe.offset_mm(place);
    if (!offset_mm) return std::nullopt;
    place -= *offset_mm;
  }
  const std::optional<SurfaceEstimate> estimate = probe.at(place);
  if (!estimate) return std::nullopt;
  place -= estimate->distance_mm * estimate->mean.normal;
  // A vertex far away from its cell belongs to another sheet of the surface.
  if ((place - sum / count).norm() > spacing_mm_) return std::nullopt;
  if (!probe.surrounded(place, estimate->mean.normal)) return std::nullopt;
  SurfacePoint vertex = estimate->mean;
  vertex.position_mm = place;
  return vertex;
}

void Extraction::number_vertices() {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (places_[i] == kNotPlaced) continue;
    net_cells_.push_back(cells_[i]);
    mesh_.vertices.push_back(placed_[places_[i]]);
  }
}

void Extraction::add_quad(const std::array<std::uint32_t, 4>& ring,
                          std::vector<Triangle>& triangles) const {
  const auto length2 = [&](int i, int j) {
    return (mesh_.vertices[ring[i]].position_mm - mesh_.vertices[ring[j]].position_mm)
        .squaredNorm();
  };
  // The shorter diagonal gives the rounder triangles.
  if (length2(0, 2) <= length2(1, 3)) {
    triangles.push_back({ring[0], ring[1], ring[2]});
    triangles.push_back({ring[0], ring[2], ring[3]});
  } else {
    triangles.push_back({ring[0], ring[1], ring[3]});
    triangles.push_back({ring[1], ring[2], ring[3]});
  }
}

/// @returns false if canceled
bool Extraction::connect(const Progress& progress) {
  constexpr std::size_t kCorners = 1U << 14U;
  const std::size_t corner_count = grid_.corners.size();
  std::vector<std::vector<Triangle>> parts((corner_count + kCorners - 1) / kCorners);
  const auto connect_part = [&](std::size_t part) {
    NetEdges edges(grid_, net_cells_);
    const std::size_t end = std::min(corner_count, (part + 1) * kCorners);
    for (std::size_t i = part * kCorners; i < end; ++i) {
      edges.from_corner(
          i, [&](const std::array<std::uint32_t, 4>& ring) { add_quad(ring, parts[part]); });
    }
  };
  if (!workers_.for_each_unless_cancelled(parts.size(), connect_part, progress)) return false;
  for (const std::vector<Triangle>& part : parts)
    mesh_.triangles.insert(mesh_.triangles.end(), part.begin(), part.end());
  return true;
}

}  // namespace

Result<TriangleMesh> extract_surface(const ImplicitSurface& surface, const PointCloud& points,
                                     float spacing_mm, const Workers& workers,
                                     const Progress& progress) {
  return Extraction(surface, spacing_mm, workers, progress).run(points);
}

}  // namespace flytri::meshing
