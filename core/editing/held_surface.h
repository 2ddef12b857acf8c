/// @file  The part of a finished surface that is locked: it stays the same to the bit when the scan
/// is finished again.
#pragma once

#include <memory>
#include <vector>

#include "core/editing/edits.h"
#include "core/geometry/point_cloud.h"

namespace flytri::editing {

/// What the next run needs of a finished scan to keep its surface. All in the world of that scan.
struct HeldSurface {
  /// A frame, known by its time: a copy of a stage numbers its frames anew.
  struct PlacedFrame {
    double time_s = 0.0;
    Isometry T_world_sensor = Isometry::Identity();
    Vec3f gain = Vec3f::Ones();  ///< of a texture frame, see texture::level_frames()
  };
  double spacing_mm = 0.0;          ///< > 0, of the mesh
  double seen_until_s = 0.0;        ///< time of the last view in it
  std::vector<double> edited_at_s;  ///< times of the edits that applied
  std::vector<PlacedFrame> views, textures;
  PointCloud points;                   ///< reduced, with their colors
  std::vector<SurfacePoint> vertices;  ///< of the mesh, with their colors
};

/// Which places of a finished surface are held: those that were locked while it was the present
/// one. A lock that came after newer views protects what these saw, and so holds nothing older.
class HeldPlaces {
 public:
  /// @param edits         those that apply now
  /// @param seen_next_s   time of the first view that is not in the surface; infinite: none
  HeldPlaces(const EditList& edits, const HeldSurface& surface, double seen_next_s);

  [[nodiscard]] bool empty() const { return is_empty_; }
  [[nodiscard]] bool holds(const Vec3f& position_mm, const Vec3f& normal) const;
  /// Whether a lock may reach this place, whatever its normal.
  [[nodiscard]] bool touches(const Vec3f& position_mm) const { return locks_.touches(position_mm); }

 private:
  HeldPlaces(const EditList& locks, const EditList& later, double seen_until_s);

  EditFilter locks_;  ///< those that hold, and what ends them
  EditFilter later_;  ///< what was done to the surface since
  double seen_until_s_;
  bool is_empty_;
};

}  // namespace flytri::editing
