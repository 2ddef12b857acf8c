/// @file  Divides points with poses into cells of space; fits a surface to each cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/workers.h"
#include "core/geometry/view.h"

namespace flytri::refinement {

/// The mean of a few neighboring points of one profile. Neighbors share noise and show the same
/// place, so little information is lost and the computation is ten times faster.
struct Datum {
  Vec3 position_mm;   ///< sensor frame
  Vec3 deviation_mm;  ///< mean of the points' deviations, sensor frame
  Vec3 sheet_normal;  ///< unit normal of the light sheet, sensor frame
  ViewIndex view;
};

/// All data of a scan, sorted by view.
/// @param length_mm  > 0, length of a profile that becomes one datum
[[nodiscard]] std::vector<Datum> gather_data(std::span<const AlignedView> views, double length_mm,
                                             const Workers& workers);

/// Terms of the local surface h(a, b) = s . (1, a, b, aa, ab, bb), a and b in units of the cell.
using Quadric = Eigen::Matrix<double, 6, 1>;

/// One cell of space with the surface in it.
struct SurfaceCell {
  std::vector<std::uint32_t> data;                             ///< indices of its data, rising
  Vec3 origin_mm = Vec3::Zero();                               ///< world frame
  Eigen::Matrix3d R_world_cell = Eigen::Matrix3d::Identity();  ///< columns a, b, h (outwards)
  Quadric surface = Quadric::Zero();                           ///< h in mm
  bool valid = false;  ///< seen by two views, and the quadric was fitted
};

/// Residual of one datum against its cell's surface.
struct SurfaceResidual {
  double residual_mm = 0.0;  ///< signed height of the point above the surface
  double sigma_mm = 0.0;     ///< standard uncertainty of that height
  Vec3 gradient;             ///< of the height with respect to the position, world frame, at the
                             ///< foot point
  Vec3 foot_mm;              ///< where the measurement ray meets the surface, world frame
  Quadric terms;             ///< (1, a, b, aa, ab, bb) at the foot point
  bool usable = false;       ///< false if the ray grazes the surface
};

/// Sorts the data into cubes of space.
[[nodiscard]] std::vector<SurfaceCell> divide_space(std::span<const Datum> data,
                                                    std::span<const Isometry> T_world_sensor,
                                                    double cell_mm, const Workers& workers);

/// Fits the surface of a cell robustly. The cell stays invalid if its data do not form one surface.
void fit_surface(SurfaceCell& cell, std::span<const Datum> data,
                 std::span<const Isometry> T_world_sensor, double cell_mm);

/// Residual of a datum against its cell's valid surface.
[[nodiscard]] SurfaceResidual residual_of(const SurfaceCell& cell, const Datum& datum,
                                          const Isometry& T_world_sensor, double cell_mm);

/// Weight of a normalized residual, 0 beyond `limit`.
/// @source  Tukey's biweight; Beaton and Tukey, Technometrics 16, 1974.
[[nodiscard]] double tukey_weight(double normalized_residual, double limit);

}  // namespace flytri::refinement
