#include "core/tracking/surface_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/geometry/cell_key.h"
#include "core/geometry/decompositions.h"

namespace flytri::tracking {
namespace {

/// Sides of cells, as shares of the radius.
constexpr double kFineShare = 0.08, kCoarseShare = 0.16, kPlaceShare = 0.3;
/// Half of the distance of neighboring lines.
constexpr double kGapShare = 0.17;
/// Distances are cut off here.
constexpr double kFineMostShare = 0.4, kCoarseMostShare = 0.25;
/// Room around the surface for the views that are searched, as a share of the radius: half of a
/// view.
constexpr double kMarginShare = 3.0;
/// More cells than this take coarser ones: the surface is then wider than any jaw.
constexpr double kMostCells = 3e7;
/// Every n-th knot of a profile is taken: knots are closer together than cells.
constexpr std::size_t kMapKnotStride = 2;

struct Sum {
  Vec3 points_mm = Vec3::Zero();
  Vec3 sights = Vec3::Zero();
  Eigen::Matrix3d products_mm2 = Eigen::Matrix3d::Zero();
  int count = 0;

  void add(const Vec3& p_mm, const Vec3& sight) {
    points_mm += p_mm;
    sights += sight;
    products_mm2 += p_mm * p_mm.transpose();
    ++count;
  }
};

using Cells = std::unordered_map<CellKey, Sum>;

/// The direction in which the points spread least, towards the sensor. Points on a line leave it
/// open: then the direction that is most against the sight.
Vec3 normal_of(const Sum& sum, const Vec3& mean_mm, const Vec3& sight) {
  constexpr double kLineShare = 0.02;
  const auto spread = direct_symmetric_eigen(
      Eigen::Matrix3d(sum.products_mm2 / sum.count - mean_mm * mean_mm.transpose()));
  const Vec3 along = spread.vectors.col(2);
  const bool is_line = spread.values[1] < kLineShare * spread.values[2];
  const Vec3 normal =
      is_line ? (sight - along * along.dot(sight)).stableNormalized() : Vec3(spread.vectors.col(0));
  return normal.dot(sight) > 0.0 ? Vec3(-normal) : normal;
}

/// The mean of each cell, in the order of the cells.
std::vector<SurfacePlace> means_of(const Cells& cells) {
  std::vector<std::pair<CellKey, const Sum*>> sorted;
  sorted.reserve(cells.size());
  for (const auto& [key, sum] : cells) sorted.emplace_back(key, &sum);
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SurfacePlace> means;
  means.reserve(sorted.size());
  for (const auto& [key, sum] : sorted) {
    const Vec3 mean_mm = sum->points_mm / sum->count, sight = sum->sights.stableNormalized();
    means.push_back({mean_mm, sight, normal_of(*sum, mean_mm, sight)});
  }
  return means;
}

std::vector<SurfacePlace> cells_of(const TrackedScan& scan, double cell_mm) {
  Cells cells;
  for (const TrackedView& view : scan.views()) {
    const Vec3 sight = view.aligned.T_world_sensor.linear().col(2);
    for (const registration::PreparedProfile& profile : view.placed.profiles) {
      for (std::size_t i = 0; i < profile.curve.knot_count(); i += kMapKnotStride) {
        const Vec3 p_mm = profile.curve.knot_mm(i).cast<double>();
        cells[CellKey::at(p_mm, cell_mm)].add(p_mm, sight);
      }
    }
  }
  return means_of(cells);
}

std::vector<SurfacePlace> cells_of(const TriangleMesh& mesh, double cell_mm) {
  Cells cells;
  for (const SurfacePoint& vertex : mesh.vertices) {
    const Vec3 p_mm = vertex.position_mm.cast<double>();
    cells[CellKey::at(p_mm, cell_mm)].add(p_mm, -vertex.normal.cast<double>());
  }
  return means_of(cells);
}

std::vector<SurfacePlace> in_larger_cells(const std::vector<SurfacePlace>& places, double cell_mm) {
  Cells cells;
  for (const SurfacePlace& place : places) {
    cells[CellKey::at(place.p_mm, cell_mm)].add(place.p_mm, place.sight);
  }
  return means_of(cells);
}

}  // namespace

DistanceGrid::DistanceGrid(const std::vector<SurfacePlace>& surface, double cell_mm, double gap_mm,
                           double most_mm, double margin_mm)
    : cell_mm_(cell_mm), most_mm_(most_mm) {
  Eigen::AlignedBox3d box;
  for (const SurfacePlace& place : surface) box.extend(place.p_mm);
  if (box.isEmpty()) return;
  const Vec3 size_mm = box.sizes() + Vec3::Constant(2.0 * margin_mm);
  cell_mm_ = std::max(cell_mm_, std::cbrt(size_mm.prod() / kMostCells));
  corner_mm_ = box.min() - Vec3::Constant(margin_mm);
  size_ = (size_mm / cell_mm_).array().ceil().cast<int>() + 2;
  strides_ = {1, size_.x(), size_.x() * size_.y()};
  const auto cells = static_cast<std::size_t>(strides_.z()) * static_cast<std::size_t>(size_.z());
  const auto most2_mm2 = static_cast<float>(most_mm_ * most_mm_);
  std::vector<Nearest> nearest(cells, {most2_mm2, 0});
  for (std::uint32_t i = 0; i < surface.size(); ++i) stamp(surface, i, nearest);
  distances_mm_.assign(cells, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < cells; ++i) {
    if (nearest[i].distance2_mm2 >= most2_mm2) continue;
    const SurfacePlace& place = surface[nearest[i].place];
    const auto away_mm = static_cast<double>(std::sqrt(nearest[i].distance2_mm2));
    const double along_mm = place.normal.dot(center_mm(i) - place.p_mm);
    const double aside2_mm2 = away_mm * away_mm - along_mm * along_mm;
    if (aside2_mm2 <= gap_mm * gap_mm) distances_mm_[i] = static_cast<float>(along_mm);
  }
}

Vec3 DistanceGrid::center_mm(std::size_t cell) const {
  const auto i = static_cast<int>(cell);
  const Eigen::Vector3i place(i % size_.x(), i / size_.x() % size_.y(), i / strides_.z());
  return corner_mm_ + cell_mm_ * (place.cast<double>() + Vec3::Constant(0.5));
}

void DistanceGrid::stamp(const std::vector<SurfacePlace>& surface, std::uint32_t place,
                         std::vector<Nearest>& nearest) const {
  const Vec3f at = ((surface[place].p_mm - corner_mm_) / cell_mm_ - Vec3::Constant(0.5))
                       .cast<float>();  // in cells, from the center of the first one
  const auto reach = static_cast<float>(most_mm_ / cell_mm_);
  const Eigen::Vector3i from = (at.array() - reach).ceil().cast<int>().max(0);
  const Eigen::Vector3i to = (at.array() + reach).floor().cast<int>().min(size_.array() - 1);
  const auto cell2_mm2 = static_cast<float>(cell_mm_ * cell_mm_);
  const auto off2_mm2 = [&](int axis, int i) {
    const float off = static_cast<float>(i) - at[axis];
    return cell2_mm2 * off * off;
  };
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      const float far2_mm2 = off2_mm2(2, z) + off2_mm2(1, y);
      Nearest* row = nearest.data() + static_cast<std::ptrdiff_t>(z) * strides_.z() +
                     static_cast<std::ptrdiff_t>(y) * strides_.y();
      for (int x = from.x(); x <= to.x(); ++x) {
        const float distance2_mm2 = far2_mm2 + off2_mm2(0, x);
        if (distance2_mm2 < row[x].distance2_mm2) row[x] = {distance2_mm2, place};
      }
    }
  }
}

DistanceGrid::Sample DistanceGrid::at(const Vec3& p_mm) const {
  const Vec3 place = (p_mm - corner_mm_) / cell_mm_ - Vec3::Constant(0.5);
  const Vec3 low = place.array().floor();
  if ((low.array() < 0.0).any() || (low.array() + 1.0 >= size_.cast<double>().array()).any()) {
    return {};
  }
  const Vec3 b = place - low, a = Vec3::Ones() - b;
  const float* d = &distances_mm_[static_cast<std::size_t>(low.cast<int>().dot(strides_))];
  const int y = strides_.y(), z = strides_.z();
  // Along x first, then y, then z.
  const double d00 = a.x() * d[0] + b.x() * d[1], d10 = a.x() * d[y] + b.x() * d[y + 1];
  const double d01 = a.x() * d[z] + b.x() * d[z + 1];
  const double d11 = a.x() * d[z + y] + b.x() * d[z + y + 1];
  const double x0 = a.y() * (d[1] - d[0]) + b.y() * (d[y + 1] - d[y]);
  const double x1 = a.y() * (d[z + 1] - d[z]) + b.y() * (d[z + y + 1] - d[z + y]);
  const double low_mm = a.y() * d00 + b.y() * d10, high_mm = a.y() * d01 + b.y() * d11;
  const double distance_mm = a.z() * low_mm + b.z() * high_mm;
  return {
      !std::isnan(distance_mm), distance_mm,
      Vec3(a.z() * x0 + b.z() * x1, a.z() * (d10 - d00) + b.z() * (d11 - d01), high_mm - low_mm) /
          cell_mm_};
}

SurfaceMap::SurfaceMap(const TrackedScan& scan, double radius_mm) {
  build(cells_of(scan, kFineShare * radius_mm), radius_mm);
}

SurfaceMap::SurfaceMap(const TriangleMesh& mesh, double radius_mm) {
  build(cells_of(mesh, kFineShare * radius_mm), radius_mm);
}

void SurfaceMap::build(std::vector<SurfacePlace> cells, double radius_mm) {
  places = in_larger_cells(cells, kPlaceShare * radius_mm);
  const double coarse_mm = kCoarseShare * radius_mm;
  const std::vector<SurfacePlace> coarse_cells = in_larger_cells(cells, coarse_mm);
  // A fine cell alone has too few points for a normal.
  std::unordered_map<CellKey, Vec3> normals;
  for (const SurfacePlace& cell : coarse_cells) {
    normals.emplace(CellKey::at(cell.p_mm, coarse_mm), cell.normal);
  }
  for (SurfacePlace& cell : cells) cell.normal = normals.at(CellKey::at(cell.p_mm, coarse_mm));
  const double gap_mm = kGapShare * radius_mm;
  fine = DistanceGrid(cells, kFineShare * radius_mm, gap_mm, kFineMostShare * radius_mm,
                      kFineMostShare * radius_mm);
  coarse = DistanceGrid(coarse_cells, coarse_mm, gap_mm, kCoarseMostShare * radius_mm,
                        kMarginShare * radius_mm);
}

}  // namespace flytri::tracking
