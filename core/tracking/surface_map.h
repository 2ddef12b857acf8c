/// @file  The distance to a scanned surface, on a grid: for searching where a view fits.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "core/tracking/tracked_scan.h"

namespace flytri::tracking {

/// A part of the surface.
struct SurfacePlace {
  Vec3 p_mm = Vec3::Zero();
  Vec3 sight = Vec3::UnitZ();    ///< mean direction from which the sensor saw it, unit
  Vec3 normal = -Vec3::UnitZ();  ///< unit, towards the sensor
};

/// Distances from a surface along its normal on a regular grid, negative behind it. Beside the
/// surface and far from it they are not known. Around the surface there is a margin.
class DistanceGrid {
 public:
  DistanceGrid() = default;
  /// @param gap_mm   the surface continues along its tangents for so far: between two lines
  /// @param most_mm  places farther away from the surface are not known
  DistanceGrid(const std::vector<SurfacePlace>& surface, double cell_mm, double gap_mm,
               double most_mm, double margin_mm);

  [[nodiscard]] double cell_mm() const { return cell_mm_; }
  [[nodiscard]] double most_mm() const { return most_mm_; }
  /// NaN: not known.
  [[nodiscard]] const std::vector<float>& distances_mm() const { return distances_mm_; }
  /// Steps in the list of distances from a cell to the next one along x, y and z.
  [[nodiscard]] const Eigen::Vector3i& strides() const { return strides_; }
  /// Index of the cell that holds a place, which must be within the grid.
  [[nodiscard]] int index_of(const Vec3& p_mm) const {
    return ((p_mm - corner_mm_) / cell_mm_).array().floor().cast<int>().matrix().dot(strides_);
  }

  struct Sample {
    bool is_known = false;
    double distance_mm = 0.0;
    Vec3 slope = Vec3::Zero();
  };
  /// Interpolated between cells, if all of them are known.
  [[nodiscard]] Sample at(const Vec3& p_mm) const;

 private:
  /// The nearest place of the surface to each cell.
  struct Nearest {
    float distance2_mm2 = 0.0F;
    std::uint32_t place = 0;
  };
  void stamp(const std::vector<SurfacePlace>& surface, std::uint32_t place,
             std::vector<Nearest>& nearest) const;
  [[nodiscard]] Vec3 center_mm(std::size_t cell) const;

  Vec3 corner_mm_ = Vec3::Zero();
  double cell_mm_ = 1.0, most_mm_ = 1.0;
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero(), strides_ = Eigen::Vector3i::Zero();
  std::vector<float> distances_mm_;
};

/// The surface that a scan has seen.
struct SurfaceMap {
  /// @param radius_mm  of what the sensor sees
  SurfaceMap(const TrackedScan& scan, double radius_mm);
  /// Of a finished surface, as if each place had been seen along its normal.
  SurfaceMap(const TriangleMesh& mesh, double radius_mm);

  std::vector<SurfacePlace> places;  ///< about a third of the radius apart
  DistanceGrid coarse, fine;

 private:
  void build(std::vector<SurfacePlace> cells, double radius_mm);
};

}  // namespace flytri::tracking
