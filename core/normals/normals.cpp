#include "core/normals/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/base/check_options.h"
#include "core/geometry/cell_key.h"
#include "core/geometry/decompositions.h"
#include "core/geometry/point_spacing.h"

namespace flytri::normals {
namespace {

constexpr double kTangentSpacings = 4.0;
constexpr double kCellSpacings = 10.0;
/// The Gaussian is cut off where it is 1 %.
constexpr double kGaussianReach = 3.0;

/// Both patterns are needed: the one with fewer points must have at least this share of the
/// other's.
constexpr double kMinPatternShare = 0.05;

/// How far normals are extended into places with only one pattern, in cells.
constexpr int kExtensionRings = 3;
constexpr std::size_t kCellGrain = 256;

/// Share of the total time of each part.
constexpr double kTangentShare = 0.4, kGatherShare = 0.35, kCrossingShare = 0.1,
                 kExtensionShare = 0.05, kPointShare = 0.1;

/// o of every point of a view, sensor frame, unit; by profile, by point.
using ViewTangents = std::vector<std::vector<Vec3>>;

/// o: derivative of the profile after smoothing with a Gaussian of `sigma` points.
std::vector<Vec3> tangents_of(const Profile& profile, double sigma_points) {
  const auto count = static_cast<std::ptrdiff_t>(profile.points.size());
  const auto reach = std::max<std::ptrdiff_t>(1, std::lround(kGaussianReach * sigma_points));
  std::vector<double> weights;  // by distance in points
  for (std::ptrdiff_t d = 0; d <= reach; ++d) {
    const auto k = static_cast<double>(d);
    weights.push_back(std::exp(-0.5 * k * k / (sigma_points * sigma_points)));
  }
  std::vector<Vec3> tangents(profile.points.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    // Slope of a weighted straight line; one-sided at the ends.
    double sum_w = 0.0, sum_k = 0.0;
    Vec3 sum_p = Vec3::Zero(), sum_kp = Vec3::Zero();
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - reach);
         j <= std::min(count - 1, i + reach); ++j) {
      const auto k = static_cast<double>(j - i);
      const double w = weights[static_cast<std::size_t>(std::abs(j - i))];
      const Vec3& p = profile.points[static_cast<std::size_t>(j)].position_mm;
      sum_w += w;
      sum_k += w * k;
      sum_p += w * p;
      sum_kp += w * k * p;
    }
    tangents[static_cast<std::size_t>(i)] = (sum_kp - sum_k / sum_w * sum_p).normalized();
  }
  return tangents;
}

ViewTangents tangents_of(const View& view, double sigma_mm) {
  ViewTangents tangents;
  for (const Profile& profile : view.profiles) {
    const Vec3 span = profile.points.back().position_mm - profile.points.front().position_mm;
    const double spacing_mm = span.norm() / static_cast<double>(profile.points.size() - 1);
    tangents.push_back(tangents_of(profile, std::max(1.0, sigma_mm / std::max(spacing_mm, 1e-9))));
  }
  return tangents;
}

/// Sums over all profile points in one cell: o o^T, and the directions to the sensors.
struct TangentCell {
  CellKey key;
  Eigen::Matrix3d oo = Eigen::Matrix3d::Zero();
  Vec3 towards_sensor = Vec3::Zero();
  std::array<double, 2> weight{};  ///< points by pattern
  Vec3 normal = Vec3::Zero();      ///< zero: profiles do not cross here
};

const TangentCell* find_cell(std::span<const TangentCell> cells, const CellKey& key) {
  const auto it = std::lower_bound(
      cells.begin(), cells.end(), key,
      [](const TangentCell& cell, const CellKey& wanted) { return cell.key < wanted; });
  return it != cells.end() && it->key == key ? &*it : nullptr;
}

/// Sums item(index) over the members of each cell.
template <typename Item>
std::vector<TangentCell> sum_by_key(std::vector<CellMember> keyed, const Item& item) {
  sort_by_cell(keyed);
  std::vector<TangentCell> sums;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    const TangentCell& cell = item(keyed[i].second);
    if (i == 0 || keyed[i].first != keyed[i - 1].first) {
      sums.push_back(cell);
      sums.back().key = keyed[i].first;
      continue;
    }
    sums.back().oo += cell.oo;
    sums.back().towards_sensor += cell.towards_sensor;
    for (const int p : {0, 1}) sums.back().weight[p] += cell.weight[p];
  }
  return sums;
}

std::vector<TangentCell> gather_cells(const AlignedView& aligned, const ViewTangents& tangents,
                                      double cell_mm) {
  const Isometry& T_world_sensor = aligned.T_world_sensor;
  std::vector<CellMember> keyed;
  std::vector<Vec3> directions;  // by point
  keyed.reserve(aligned.view->point_count());
  directions.reserve(aligned.view->point_count());
  for (std::size_t k = 0; k < tangents.size(); ++k) {
    for (std::size_t i = 0; i < tangents[k].size(); ++i) {
      const Vec3& p_sensor = aligned.view->profiles[k].points[i].position_mm;
      keyed.emplace_back(CellKey::at(Vec3(T_world_sensor * p_sensor), cell_mm),
                         static_cast<std::uint32_t>(keyed.size()));
      directions.emplace_back(T_world_sensor.linear() * tangents[k][i]);
    }
  }
  TangentCell of_point;
  of_point.towards_sensor = -T_world_sensor.linear().col(2);
  of_point.weight[static_cast<std::size_t>(aligned.view->pattern)] = 1.0;
  return sum_by_key(std::move(keyed), [&](std::uint32_t i) -> const TangentCell& {
    of_point.oo = directions[i] * directions[i].transpose();
    return of_point;
  });
}

/// Sums the points of each view, then all views in order, so that the result does not depend on the
/// number of threads.
Result<std::vector<TangentCell>> gather_cells(std::span<const AlignedView> views,
                                              std::span<const ViewTangents> tangents,
                                              double cell_mm, const Workers& workers,
                                              const Progress& progress) {
  std::vector<std::vector<TangentCell>> of_views(views.size());
  const bool complete = workers.for_each_unless_cancelled(
      views.size(),
      [&](std::size_t v) { of_views[v] = gather_cells(views[v], tangents[v], cell_mm); }, progress);
  if (!complete) return stopped();
  std::vector<const TangentCell*> all;
  std::vector<CellMember> keyed;
  for (const auto& cells : of_views) {
    for (const TangentCell& cell : cells) {
      keyed.emplace_back(cell.key, static_cast<std::uint32_t>(all.size()));
      all.push_back(&cell);
    }
  }
  return sum_by_key(std::move(keyed),
                    [&](std::uint32_t i) -> const TangentCell& { return *all[i]; });
}

/// Calls visit(cell, binomial weight) for a cell and its neighbors.
template <typename Visit>
void for_neighbors(std::span<const TangentCell> cells, const CellKey& key, const Visit& visit) {
  constexpr std::array<double, 4> kWeights = {1.0, 0.5, 0.25, 0.125};
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        const TangentCell* cell = find_cell(cells, key.neighbor(i, j, k));
        if (cell != nullptr) visit(*cell, kWeights[std::abs(i) + std::abs(j) + std::abs(k)]);
      }
    }
  }
}

/// Sum over the cell and its neighbors, so that normals change smoothly.
TangentCell blend(std::span<const TangentCell> cells, const CellKey& key) {
  TangentCell sum;
  sum.key = key;
  for_neighbors(cells, key, [&](const TangentCell& cell, double weight) {
    sum.oo += weight * cell.oo;
    sum.towards_sensor += weight * cell.towards_sensor;
    for (const int p : {0, 1}) sum.weight[p] += weight * cell.weight[p];
  });
  return sum;
}

/// The direction most perpendicular to all o, or zero if they are nearly parallel.
Vec3 common_normal(const TangentCell& cell, double min_crossing_sine) {
  // The o of one curved profile vary too, but within its light sheet: that is not a crossing.
  const auto [few, many] = std::minmax(cell.weight[0], cell.weight[1]);
  if (few < kMinPatternShare * many) return Vec3::Zero();
  const auto [eigenvalues, axes] = symmetric_eigen(cell.oo);
  // For two equal sets of directions at angle t, the middle eigenvalue is (1 - cos t) / 2 of the
  // sum of the eigenvalues.
  const double min_share = 0.5 * (1.0 - std::sqrt(1.0 - min_crossing_sine * min_crossing_sine));
  if (eigenvalues[1] < min_share * eigenvalues.sum()) return Vec3::Zero();
  const Vec3 normal = axes.col(0);
  return normal.dot(cell.towards_sensor) < 0.0 ? Vec3(-normal) : normal;
}

/// Sets the normal of each cell in which profiles cross. @returns false if canceled
bool cross_tangents(std::vector<TangentCell>& cells, const NormalOptions& options,
                    const Workers& workers, const Progress& progress) {
  std::vector<Vec3> normals(cells.size());
  const bool complete = workers.for_each_unless_cancelled(
      cells.size(),
      [&](std::size_t c) {
        normals[c] = common_normal(blend(cells, cells[c].key), options.min_crossing_sine);
      },
      progress, kCellGrain);
  if (!complete) return false;
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c].normal = normals[c];
  return true;
}

/// Extends normals from neighboring cells into cells without a crossing, ring by ring.
/// @returns false if canceled
bool extend_normals(std::vector<TangentCell>& cells, const Workers& workers,
                    const Progress& progress) {
  for (int ring = 0; ring < kExtensionRings; ++ring) {
    std::vector<Vec3> extended(cells.size(), Vec3::Zero());
    const bool complete = workers.for_each_unless_cancelled(
        cells.size(),
        [&](std::size_t c) {
          if (!cells[c].normal.isZero()) return;
          for_neighbors(cells, cells[c].key, [&](const TangentCell& neighbor, double weight) {
            extended[c] += weight * neighbor.normal;
          });
        },
        progress.part(1.0 / kExtensionRings), kCellGrain);
    if (!complete) return false;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (!extended[c].isZero()) cells[c].normal = extended[c].normalized();
    }
  }
  return true;
}

/// `n` made perpendicular to the point's own o; zero if that leaves little.
Vec3 perpendicular(const Vec3& n, const Vec3& o) {
  const Vec3 normal = n - n.dot(o) * o;
  const double length = normal.norm();
  return length > 0.5 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

/// n_in: the normal within the light sheet, towards the sensor. A single profile gives only this.
Vec3 in_plane_normal(const Vec3& sheet_normal, const Vec3& o, const Vec3& towards_sensor) {
  const Vec3 n_in = o.cross(sheet_normal).normalized();
  return n_in.dot(towards_sensor) < 0.0 ? Vec3(-n_in) : n_in;
}

ViewNormals normals_of(const AlignedView& aligned, const ViewTangents& tangents,
                       std::span<const TangentCell> cells, double cell_mm) {
  ViewNormals normals(aligned.view->profiles.size());
  const TangentCell* cell = nullptr;  // often that of the point before
  const Isometry& T_world_sensor = aligned.T_world_sensor;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const auto& points = aligned.view->profiles[k].points;
    normals[k].reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const CellKey key = CellKey::at(Vec3(T_world_sensor * points[i].position_mm), cell_mm);
      if (cell == nullptr || cell->key != key) cell = find_cell(cells, key);
      const Vec3 o = T_world_sensor.linear() * tangents[k][i];
      Vec3 normal = perpendicular(cell->normal, o);
      if (normal.isZero()) {
        const Vec3 s = T_world_sensor.linear() * aligned.view->profiles[k].sheet_normal;
        normal = in_plane_normal(s, o, -T_world_sensor.linear().col(2));
      }
      normals[k].push_back(normal.cast<float>());
    }
  }
  return normals;
}

}  // namespace

Result<void> NormalOptions::validate() const {
  return OptionCheck("NormalOptions")
      .not_negative("tangent_sigma_mm", tangent_sigma_mm)
      .not_negative("cell_mm", cell_mm)
      .must("min_crossing_sine", min_crossing_sine,
            min_crossing_sine > 0.0 && min_crossing_sine < 1.0, "above 0 and below 1")
      .result();
}

Result<std::vector<ViewNormals>> crossing_normals(std::span<const AlignedView> views,
                                                  const NormalOptions& options,
                                                  const Workers& workers,
                                                  const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  std::vector<ViewNormals> normals(views.size());
  const double spacing_mm = median_point_spacing_mm(views);
  if (spacing_mm <= 0.0) {
    progress.advance();
    return normals;
  }
  const double sigma_mm =
      options.tangent_sigma_mm > 0.0 ? options.tangent_sigma_mm : kTangentSpacings * spacing_mm;
  const double cell_mm = options.cell_mm > 0.0 ? options.cell_mm : kCellSpacings * spacing_mm;
  std::vector<ViewTangents> tangents(views.size());
  bool complete = workers.for_each_unless_cancelled(
      views.size(), [&](std::size_t v) { tangents[v] = tangents_of(*views[v].view, sigma_mm); },
      progress.part(kTangentShare));
  if (!complete) return stopped();
  auto cells = gather_cells(views, tangents, cell_mm, workers, progress.part(kGatherShare));
  if (!cells) return tl::unexpected(cells.error());
  if (!cross_tangents(*cells, options, workers, progress.part(kCrossingShare)) ||
      !extend_normals(*cells, workers, progress.part(kExtensionShare))) {
    return stopped();
  }
  complete = workers.for_each_unless_cancelled(
      views.size(),
      [&](std::size_t v) { normals[v] = normals_of(views[v], tangents[v], *cells, cell_mm); },
      progress.part(kPointShare));
  if (!complete) return stopped();
  return normals;
}

std::vector<SurfaceSample> surface_samples(std::span<const AlignedView> views,
                                           std::span<const ViewNormals> normals,
                                           const Workers& workers) {
  std::vector<std::size_t> starts(views.size() + 1, 0);
  workers.for_each(views.size(), [&](std::size_t v) {
    for (const std::vector<Vec3f>& of_profile : normals[v]) {
      starts[v + 1] += static_cast<std::size_t>(
          std::count_if(of_profile.begin(), of_profile.end(),
                        [](const Vec3f& normal) { return !normal.isZero(); }));
    }
  });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<SurfaceSample> samples(starts.back());
  workers.for_each(views.size(), [&](std::size_t v) {
    const Isometry& T_world_sensor = views[v].T_world_sensor;
    auto sample = samples.begin() + static_cast<std::ptrdiff_t>(starts[v]);
    for (std::size_t k = 0; k < views[v].view->profiles.size(); ++k) {
      const auto& points = views[v].view->profiles[k].points;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (normals[v][k][i].isZero()) continue;
        *sample++ = {(T_world_sensor * points[i].position_mm).cast<float>(), normals[v][k][i],
                     T_world_sensor.linear().cast<float>() * points[i].deviation_mm, ViewIndex(v),
                     views[v].view->pattern};
      }
    }
  });
  return samples;
}

}  // namespace flytri::normals
