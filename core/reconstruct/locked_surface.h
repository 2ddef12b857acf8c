/// @file  Keeps what is locked of the surface of an earlier run.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>

#include "core/editing/held_surface.h"
#include "core/geometry/view.h"

namespace flytri::reconstruct {

/// What a new run takes over from an earlier one. Empty: nothing is locked, and all functions
/// change nothing.
class LockedSurface {
 public:
  /// @param views  of the new run, by rising time
  /// @param edits  that apply now
  /// @param held   of the earlier run; may be null
  LockedSurface(std::span<const AlignedView> views, const editing::EditList& edits,
                std::shared_ptr<const editing::HeldSurface> held);

  [[nodiscard]] bool empty() const { return !places_; }
  [[nodiscard]] bool holds(const Vec3f& position_mm, const Vec3f& normal) const {
    return places_ && places_->holds(position_mm, normal);
  }
  /// Not for an empty one.
  [[nodiscard]] double spacing_mm() const { return held_->spacing_mm; }

  /// The motion that brings what the earlier views saw of the locked places back to where it was.
  /// @param views  with their new poses
  /// @return  T_held_world
  [[nodiscard]] Isometry place(std::span<const AlignedView> views) const;
  /// Replaces the points in the locked places by the former ones, which come first.
  void keep_points(PointCloud& points) const;
  /// Gives points and vertices that are in the same place as before their former colors.
  void keep_colors(std::span<SurfacePoint> points) const;
  /// How a texture frame colored the surface. None: it did not.
  [[nodiscard]] std::optional<editing::HeldSurface::PlacedFrame> former_texture(
      double time_s) const;

 private:
  std::shared_ptr<const editing::HeldSurface> held_;
  std::optional<editing::HeldPlaces> places_;
};

}  // namespace flytri::reconstruct
