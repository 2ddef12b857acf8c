/// @file  The part of LiveSurface that hides what views have looked through.
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
    const auto found = normal_index_.find(key(center_mm, options_.normal_cells));
    if (found != normal_index_.end()) cross(normal_cells_[found->second], from_mm, direction);
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
    if (cell.is_crossed || !shown(cell)) continue;
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

void LiveSurface::show_crossed(bool is_shown) {
  if (shows_crossed_ == is_shown) return;
  shows_crossed_ = is_shown;
  for (const Cell& cell : cells_) {
    if (cell.is_crossed && cell.in_block) blocks_[cell.block].changed = true;
  }
}

}  // namespace flytri::live
