/// @file  The normal equations of all poses of a scan at given poses, cell by cell.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/refinement/reduced_system.h"
#include "core/refinement/refine.h"
#include "core/refinement/surface_cells.h"

namespace flytri::refinement {

/// The stored part of a residual. The rest is computed again when needed, to save memory.
struct ResidualSize {
  double residual_mm = 0.0;
  double sigma_mm = 0.0;
  bool usable = false;
};

/// The surfaces of all cells at given poses, and the residuals of the data against them.
struct FittedSurfaces {
  double cell_mm = 0.0;
  std::vector<SurfaceCell> cells;
  std::vector<std::vector<ResidualSize>> residuals;  ///< by cell, parallel to its data
  double spread = 1.0;           ///< robust standard deviation of the normalized residuals
  double robust_sigma_mm = 0.0;  ///< of the residuals themselves
};

/// What one cell adds to the equations of the projector of one view after its surface is
/// eliminated. S is the Jacobian of the residuals with respect to the projector's twist, the rest
/// as in CellViewBlock.
struct CellProjectorShare {
  std::size_t projector = 0;
  Matrix6 coupling = Matrix6::Zero();     ///< S^T W A L^-T
  Matrix6 with_view = Matrix6::Zero();    ///< J^T W S
  Matrix6 information = Matrix6::Zero();  ///< S^T W S
  Twist gradient = Twist::Zero();
};

/// What one cell adds to the equations of one view after its surface is eliminated.
struct CellViewShare {
  CellViewBlock block;
  Matrix6 information = Matrix6::Zero();
  Twist gradient = Twist::Zero();
  std::optional<CellProjectorShare> projector;  ///< if the view's projector has moved
};

/// Adds a cell to the equations.
void add_to(ReducedSystem& system, std::span<const CellViewShare> shares);

/// Projectors that may have moved since the calibration.
struct MovedProjectors {
  /// The projector of each view; none: not moved. Empty: no projector has moved.
  std::vector<std::optional<std::size_t>> of_view;
  std::size_t count = 0;
  Vec3 p_camera_mm = Vec3::Zero();  ///< projection center of the camera, sensor frame

  [[nodiscard]] std::optional<std::size_t> of(std::size_t view) const {
    return of_view.empty() ? std::nullopt : of_view[view];
  }
};

/// The data of a scan, and the sums over them.
class JointEquations {
 public:
  /// @param views    their poses do not count
  /// @param options  valid; must outlive this
  JointEquations(std::span<const AlignedView> views, const JointRefineOptions& options,
                 const Workers& workers);

  /// From now on, the equations have the twists of these projectors as unknowns, too.
  void set_projectors(MovedProjectors projectors);
  [[nodiscard]] const MovedProjectors& projectors() const { return projectors_; }
  /// Puts the data where they are seen if the projectors have moved by these twists from where they
  /// were calibrated, sensor frame.
  void move_projectors(std::span<const Twist> motions);

  [[nodiscard]] bool empty() const { return data_.empty(); }
  [[nodiscard]] const std::vector<Datum>& data() const { return data_; }
  [[nodiscard]] double cell_mm() const { return cell_mm_; }
  /// Mean distance of the data from the sensor's origin: a rotation moves the points of a view by
  /// about this times the angle.
  [[nodiscard]] double mean_radius_mm() const;
  /// Center of each view's data, world frame.
  [[nodiscard]] std::vector<Vec3> view_centers_mm(std::span<const Isometry> poses) const;

  /// Fits the surface of each cell. If poses are wrong by much, the data of a small cell do not
  /// form a surface, so the cells are enlarged.
  /// @errors  kCancelled.
  [[nodiscard]] Result<FittedSurfaces> fit_surfaces(std::span<const Isometry> poses,
                                                    const Progress& progress) const;
  /// Near its limit, the weight of a residual falls. So a step of the solution must be this factor
  /// longer than the normal equations say, > 1.
  [[nodiscard]] double step_factor(const FittedSurfaces& surfaces) const;
  /// Number of pairs of a cell and a view with data in it.
  [[nodiscard]] std::size_t count_views_of_cells(const FittedSurfaces& surfaces) const;

  /// Takes a cell and its shares by rising view.
  using TakeCell = std::function<void(std::size_t cell, std::span<const CellViewShare> shares)>;
  /// Sums over each cell, and passes on the cells that were seen by two views and whose inliers
  /// determine their surface, in order. Needs the memory of a few cells only.
  /// @return  false if canceled
  [[nodiscard]] bool sum_cells(const FittedSurfaces& surfaces, std::span<const Isometry> poses,
                               std::span<const Vec3> centers_mm, const Progress& progress,
                               const TakeCell& take) const;

  /// How firmly the data within a radius hold each view: the sum of J^T W J for its twist about
  /// `p_mm`, by rising view.
  [[nodiscard]] std::map<std::uint32_t, Matrix6> information_near(const FittedSurfaces& surfaces,
                                                                  std::span<const Isometry> poses,
                                                                  const Vec3& p_mm,
                                                                  double radius_mm) const;

 private:
  [[nodiscard]] Result<FittedSurfaces> fit_surfaces_of(std::span<const Isometry> poses,
                                                       double cell_mm,
                                                       const Progress& progress) const;
  [[nodiscard]] std::vector<CellViewShare> sum_cell(const FittedSurfaces& surfaces, std::size_t c,
                                                    std::span<const Isometry> poses,
                                                    std::span<const Vec3> centers_mm) const;
  [[nodiscard]] double weight_of(const ResidualSize& size, double spread) const;

  const JointRefineOptions& options_;
  const Workers& workers_;
  std::vector<Datum> data_;
  double cell_mm_ = 0.0;
  MovedProjectors projectors_;
  std::vector<Vec3> calibrated_mm_;  ///< positions of the data without the projectors' motions
};

}  // namespace flytri::refinement
