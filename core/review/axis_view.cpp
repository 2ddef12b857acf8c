#include "core/review/axis_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flytri::review {
namespace {

/// Surface that is tilted less than this against the axis is along it: it is not hidden by itself
/// and hides nothing. 1e-4 rad: what float coordinates of triangles of 0.1 mm can tell.
constexpr double kAlongSine = 1e-4;
/// A place is lifted off its surface by this, so that the same wall does not hide it.
constexpr double kLift_mm = 1e-4;
constexpr int kMaxCells = 4'000'000;

/// The rotation into the view.
Eigen::Matrix3d R_view_world(const Vec3& axis) {
  Eigen::Matrix3d R;
  const Vec3 right = axis.unitOrthogonal();
  R << right.transpose(), axis.cross(right).transpose(), axis.transpose();
  return R;
}

double cross2(const Vec3& from, const Vec3& to, double x_mm, double y_mm) {
  return (to.x() - from.x()) * (y_mm - from.y()) - (to.y() - from.y()) * (x_mm - from.x());
}

}  // namespace

AxisView::AxisView(const TriangleMesh& mesh, const Vec3& axis) {
  const Eigen::Matrix3d R = R_view_world(axis);
  std::vector<Vec3> places_mm;
  places_mm.reserve(mesh.vertices.size());
  for (const SurfacePoint& vertex : mesh.vertices)
    places_mm.push_back(R * vertex.position_mm.cast<double>());
  flats_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    Flat flat{places_mm[t[0]], places_mm[t[1]], places_mm[t[2]], Vec3::Zero()};
    flat.normal = (flat.b - flat.a).cross(flat.c - flat.a).stableNormalized();
    if (flat.normal.z() > kAlongSine) flat.side = Side::kFacing;
    if (flat.normal.z() < -kAlongSine) flat.side = Side::kAway;
    flats_.push_back(flat);
  }
  fill_cells();
}

int AxisView::column_of(double x_mm) const {
  return std::clamp(static_cast<int>(std::floor((x_mm - low_mm_.x()) / cell_mm_)), 0, columns_ - 1);
}

int AxisView::row_of(double y_mm) const {
  return std::clamp(static_cast<int>(std::floor((y_mm - low_mm_.y()) / cell_mm_)), 0, rows_ - 1);
}

/// Lists the triangles over each cell, in their order.
void AxisView::fill_cells() {
  if (flats_.empty()) return;
  Eigen::AlignedBox2d box;
  for (const Flat& flat : flats_) {
    for (const Vec3* corner : {&flat.a, &flat.b, &flat.c}) box.extend(corner->head<2>());
  }
  low_mm_ = box.min(), high_mm_ = box.max();
  const Vec2 size_mm = (high_mm_ - low_mm_).cwiseMax(1e-3);
  const double area_mm2 = size_mm.x() * size_mm.y();
  cell_mm_ = std::max({std::sqrt(area_mm2 / static_cast<double>(flats_.size())),
                       std::sqrt(area_mm2 / kMaxCells), size_mm.maxCoeff() / kMaxCells * 2.0});
  columns_ = static_cast<int>(size_mm.x() / cell_mm_) + 1;
  rows_ = static_cast<int>(size_mm.y() / cell_mm_) + 1;
  const auto each_cell = [&](const Flat& flat, const auto& visit) {
    if (flat.side == Side::kAlong) return;
    const Vec3 low = flat.a.cwiseMin(flat.b).cwiseMin(flat.c);
    const Vec3 high = flat.a.cwiseMax(flat.b).cwiseMax(flat.c);
    for (int row = row_of(low.y()); row <= row_of(high.y()); ++row)
      for (int column = column_of(low.x()); column <= column_of(high.x()); ++column)
        visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
              static_cast<std::size_t>(column));
  };
  starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Flat& flat : flats_) each_cell(flat, [&](std::size_t cell) { ++starts_[cell + 1]; });
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  triangles_.resize(starts_.back());
  std::vector<std::uint32_t> at(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t t = 0; t < flats_.size(); ++t)
    each_cell(flats_[t], [&](std::size_t cell) { triangles_[at[cell]++] = t; });
}

/// Whether a triangle is over or under a place; where, if so.
bool AxisView::height_at(const Flat& flat, double x_mm, double y_mm, double& z_mm) {
  const double ab = cross2(flat.a, flat.b, x_mm, y_mm), bc = cross2(flat.b, flat.c, x_mm, y_mm),
               ca = cross2(flat.c, flat.a, x_mm, y_mm);
  const bool inside =
      (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
  if (!inside || flat.side == Side::kAlong) return false;
  z_mm =
      flat.a.z() - ((x_mm - flat.a.x()) * flat.normal.x() + (y_mm - flat.a.y()) * flat.normal.y()) /
                       flat.normal.z();
  return true;
}

Vec3 AxisView::position_mm(const Place& place) const {
  const Flat& flat = flats_[place.triangle];
  return place.shares.x() * flat.a + place.shares.y() * flat.b + place.shares.z() * flat.c;
}

bool AxisView::is_hidden(const Place& place) const {
  const Flat& own = flats_[place.triangle];
  if (own.side == Side::kAway) return true;
  const Vec3 p_mm = position_mm(place) + kLift_mm * own.normal;
  if (p_mm.x() < low_mm_.x() || p_mm.y() < low_mm_.y() || p_mm.x() > high_mm_.x() ||
      p_mm.y() > high_mm_.y())
    return false;
  const auto cell =
      static_cast<std::size_t>(row_of(p_mm.y())) * static_cast<std::size_t>(columns_) +
      static_cast<std::size_t>(column_of(p_mm.x()));
  for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
    double z_mm = 0.0;
    if (triangles_[i] != place.triangle &&
        height_at(flats_[triangles_[i]], p_mm.x(), p_mm.y(), z_mm) && z_mm > p_mm.z())
      return true;
  }
  return false;
}

bool AxisView::HeightMap::is_free(int column, int row, double z_mm) const {
  if (column < 0 || row < 0 || column >= columns || row >= rows) return true;
  const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column);
  return height_mm[cell] <= z_mm;
}

AxisView::HeightMap AxisView::height_map(double step_mm) const {
  HeightMap map;
  const Vec2 size_mm = high_mm_ - low_mm_;
  map.step_mm = std::max(step_mm, std::sqrt(size_mm.x() * size_mm.y() / kMaxCells));
  map.low_mm = low_mm_;
  map.columns = static_cast<int>(size_mm.x() / map.step_mm) + 1;
  map.rows = static_cast<int>(size_mm.y() / map.step_mm) + 1;
  map.height_mm.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows),
                       -std::numeric_limits<float>::infinity());
  const auto first = [&](double at, double low) {
    return std::max(0, static_cast<int>(std::ceil((at - low) / map.step_mm - 0.5)));
  };
  for (const Flat& flat : flats_) {
    const Vec3 low = flat.a.cwiseMin(flat.b).cwiseMin(flat.c);
    const Vec3 high = flat.a.cwiseMax(flat.b).cwiseMax(flat.c);
    for (int row = first(low.y(), low_mm_.y()); row < map.rows; ++row) {
      const double y_mm = low_mm_.y() + (row + 0.5) * map.step_mm;
      if (y_mm > high.y()) break;
      for (int column = first(low.x(), low_mm_.x()); column < map.columns; ++column) {
        const double x_mm = low_mm_.x() + (column + 0.5) * map.step_mm;
        if (x_mm > high.x()) break;
        double z_mm = 0.0;
        float& height_mm =
            map.height_mm[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                          static_cast<std::size_t>(column)];
        if (height_at(flat, x_mm, y_mm, z_mm))
          height_mm = std::max(height_mm, static_cast<float>(z_mm));
      }
    }
  }
  return map;
}

}  // namespace flytri::review
