/// @file  The part of LiveSurface that hides what has gone.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/live/live_surface.h"

namespace flytri::live {
namespace {

/// Rays of a profile lie this far apart, in cells: none misses a surfel.
constexpr double kRaySpacing = 1.0;
/// The part of a ray that counts, as distances from its point in cells. Nearer is the surface of
/// the point itself; farther away there is no scan.
constexpr float kFromCells = 5.0F, kToCells = 100.0F;
/// A ray crosses a surfel if it passes within this distance of its center, in cells.
constexpr float kNearCells = 1.5F;
/// Smallest cosine between ray and normal. Flatter rays may just pass a rim of the true surface.
constexpr float kMinCosine = 0.2F;
/// A surfel of this many points needs one more view.
constexpr std::uint32_t kPointsPerView = 16;
/// Each two views that measured a cube ask for one more that lights it and sees nothing.
constexpr int kViewsPerMissing = 2;
/// A cube that as many views measured stays.
constexpr int kMostViews = 20;
/// A cube is lit if the middle of a line passes a surfel within this distance, in cells.
constexpr double kLitWithinCells = 1.5;
/// What is turned farther away from the camera may be too dark: the smallest cosine.
constexpr float kMinFacing = 0.5F;
/// A line at this distance along the ray shows the cube itself, in cells.
constexpr float kOwnCells = 8.0F;

}  // namespace

void LiveSurface::look_through(const AlignedView& view) {
  if (options_.free_views == 0) return;
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  for (const Profile& profile : view.view->profiles) {
    const Vec3* last_mm = nullptr;
    for (const ProfilePoint& point : profile.points) {
      if (last_mm != nullptr && (point.position_mm - *last_mm).norm() < kRaySpacing * cell_mm_) {
        continue;
      }
      last_mm = &point.position_mm;
      const Vec3 to_camera = camera_center_mm_
                                 ? (*camera_center_mm_ - point.position_mm).normalized()
                                 : -Vec3::UnitZ();
      look_along((view.T_world_sensor * point.position_mm).cast<float>(),
                 R * to_camera.cast<float>());
    }
  }
}

/// Goes through the cubes along a ray.
void LiveSurface::look_along(const Vec3f& from_mm, const Vec3f& direction) {
  const auto cell_mm = static_cast<float>(cell_mm_);
  const float edge_mm = cell_mm * static_cast<float>(options_.normal_cells);
  const Vec3f begin_mm = from_mm + kFromCells * cell_mm * direction;
  const float end_mm = (kToCells - kFromCells) * cell_mm;
  Vec3f center_mm = ((begin_mm / edge_mm).array().floor() + 0.5F) * edge_mm;
  Vec3f next_mm, step_mm;  // along the ray: to the next face of each axis, and from face to face
  for (int axis = 0; axis < 3; ++axis) {
    const float speed = std::abs(direction[axis]);
    step_mm[axis] = speed > 0.0F ? edge_mm / speed : std::numeric_limits<float>::infinity();
    const float ahead_mm =
        0.5F * edge_mm + std::copysign(1.0F, direction[axis]) * (center_mm[axis] - begin_mm[axis]);
    next_mm[axis] = speed > 0.0F ? ahead_mm / speed : step_mm[axis];
  }
  for (float at_mm = 0.0F; at_mm < end_mm;) {
    const CellKey cube = key(center_mm, options_.normal_cells);
    if (normal_filter_.may_have(cube)) {
      const auto found = normal_index_.find(cube);
      if (found != normal_index_.end()) cross(normal_cells_[found->second], from_mm, direction);
    }
    int axis = 0;
    at_mm = next_mm.minCoeff(&axis);
    next_mm[axis] += step_mm[axis];
    center_mm[axis] += std::copysign(edge_mm, direction[axis]);
  }
}

/// Counts the ray for the surfels of a cube that it crosses from behind to the front.
void LiveSurface::cross(const NormalCell& cube, const Vec3f& from_mm, const Vec3f& direction) {
  const auto cell_mm = static_cast<float>(cell_mm_);
  const float near_mm = kNearCells * cell_mm;
  for (const std::uint32_t index : cube.cells) {
    // Most surfels are beside the ray: the cell itself is looked at last.
    const Surfel& surfel = surfels_[index];
    const float cosine = direction.dot(surfel.normal);
    if (cosine < kMinCosine) continue;
    const Vec3f offset_mm = surfel.position_mm - from_mm;
    const float along_mm = offset_mm.dot(surfel.normal) / cosine;
    if (along_mm < kFromCells * cell_mm) continue;
    if ((along_mm * direction - offset_mm).squaredNorm() > near_mm * near_mm) continue;
    const Cell& cell = cells_[index];
    if (cell.crossed_by == view_count_ || cell.of_view == view_count_) continue;
    if (is_gone(cell) || !shown(cell)) continue;
    count_crossing(index);
  }
}

void LiveSurface::count_crossing(std::uint32_t index) {
  Cell& cell = cells_[index];
  cell.crossed_by = view_count_;
  ++cell.crossing_views;
  const auto needed =
      static_cast<std::uint32_t>(options_.free_views) + cell.kept.point_count / kPointsPerView;
  if (static_cast<std::uint32_t>(cell.crossing_views) < needed || is_locked(cell)) return;
  set_crossed(index, true);
}

/// Where something is locked, nothing that is seen later is added.
bool LiveSurface::is_locked(const Cell& cell) const {
  return cell.edited != kNotEdited &&
         !filter_.keeps(cell.center_mm, normal_cells_[cell.normal_cell].normal,
                        std::numeric_limits<double>::infinity());
}

void LiveSurface::set_crossed(std::uint32_t index, bool is_crossed) {
  Cell& cell = cells_[index];
  cell.is_crossed = is_crossed;
  crossed_count_ += is_crossed ? 1 : -1;
  if (cell.in_block) blocks_[cell.block].changed = true;
}

void LiveSurface::look_for_missing(const AlignedView& view) {
  if (!light_ || options_.missing_views == 0) return;
  const Isometry T_sensor_world = view.T_world_sensor.inverse();
  const Vec3f middle_mm = view.T_world_sensor.translation().cast<float>();
  const calibration::MeasurementVolume& volume = light_->calibration().volume;
  const auto reach_mm = static_cast<float>(0.5 * volume.size_mm.norm());
  // From the middle of a cube to its corners, and a little more for rounding.
  const double to_corner_mm = 0.9 * options_.normal_cells * cell_mm_;
  const SeenLines seen(*view.view, light_->calibration());
  for (NormalCell& cube : normal_cells_) {
    const int views = cube.views[0] + cube.views[1];
    if (cube.missing_count > 0 || !cube.has_points || views >= kMostViews) continue;
    if (std::max(cube.latest_view[0], cube.latest_view[1]) == view_count_) continue;
    if ((cube.center_mm - middle_mm).squaredNorm() > reach_mm * reach_mm) continue;
    if (!volume.contains(T_sensor_world * cube.center_mm.cast<double>(), to_corner_mm)) continue;
    if (!is_missing(cube, T_sensor_world, seen)) continue;
    if (++cube.missing_views >= options_.missing_views + views / kViewsPerMissing)
      hide_missing(cube);
  }
}

bool LiveSurface::is_missing(const NormalCell& cube, const Isometry& T_sensor_world,
                             const SeenLines& seen) const {
  const auto own_mm = static_cast<float>(kOwnCells * cell_mm_);
  bool is_lit = false;
  for (const std::uint32_t index : cube.cells) {
    // Most surfels lie between the lines: the cell itself is looked at last.
    const Surfel& surfel = surfels_[index];
    const Vec3 p_sensor = T_sensor_world * surfel.position_mm.cast<double>();
    const auto line = light_->line_at(seen.pattern(), p_sensor, kLitWithinCells * cell_mm_);
    if (!line) continue;
    // Also while the user looks at what has gone.
    if (cells_[index].is_crossed || !shown(cells_[index])) continue;
    const Vec3 normal = T_sensor_world.linear() * surfel.normal.cast<double>();
    if (!light_->faces_camera(p_sensor, normal, kMinFacing)) continue;
    const auto depth_mm = seen.depth_mm(*line);
    // The line shows the place, or what hides it.
    if (depth_mm && *depth_mm < static_cast<float>(p_sensor.z()) + own_mm) return false;
    is_lit = true;
  }
  return is_lit;
}

/// What is locked stays.
void LiveSurface::hide_missing(NormalCell& cube) {
  std::uint32_t count = 0;
  for (const std::uint32_t index : cube.cells) {
    const Cell& cell = cells_[index];
    if (is_locked(cell)) return;
    if (!shown(cell) || cell.is_crossed) continue;
    ++count;
    if (cell.in_block) blocks_[cell.block].changed = true;
  }
  cube.missing_count = count;
  crossed_count_ += count;
}

void LiveSurface::show_missing(NormalCell& cube) {
  crossed_count_ -= cube.missing_count;
  cube.missing_count = 0;
  for (const std::uint32_t index : cube.cells) {
    if (cells_[index].in_block) blocks_[cells_[index].block].changed = true;
  }
}

void LiveSurface::show_crossed(bool is_shown) {
  if (shows_crossed_ == is_shown) return;
  shows_crossed_ = is_shown;
  for (const Cell& cell : cells_) {
    if (is_gone(cell) && cell.in_block) blocks_[cell.block].changed = true;
  }
}

}  // namespace flytri::live
