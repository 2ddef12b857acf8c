/// @file  The normal equations of all poses of a scan at given poses, cell by cell.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/refinement/reduced_system.h"
#include "core/refinement/refine.h"
#include "core/refinement/rolling_shutter.h"
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

/// Unknowns that many views share come in groups: the six of a projector, or a single one. They
/// have as many rows or columns as a group has unknowns.
using SharedVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using SharedMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// What one cell adds to the equations of a group by one view, after its surface is eliminated.
/// S: derivatives of the residuals by the group's unknowns. Other letters: see CellViewBlock.
struct CellSharedShare {
  std::size_t group = 0;
  SharedMatrix coupling;     ///< S^T W A L^-T
  SharedMatrix with_view;    ///< J^T W S
  SharedMatrix information;  ///< S^T W S
  SharedVector gradient;
};

/// What one cell adds to the equations of one view after its surface is eliminated.
struct CellViewShare {
  CellViewBlock block;
  Matrix6 information = Matrix6::Zero();
  Twist gradient = Twist::Zero();
  std::unique_ptr<CellSharedShare> shared;  ///< if the view depends on a group
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

  /// From now on, the equations have the readout of a rolling shutter as an unknown, too. Not
  /// together with projectors.
  void set_rolling_shutter(const trajectory::RowShare& row_share);
  [[nodiscard]] bool has_rolling_shutter() const { return !row_shares_.empty(); }
  /// Puts the data where they were at the time of their view.
  /// @param velocities  of the sensor, by view
  void move_rows(std::span<const Twist> velocities, double readout_s);

  /// Number of groups of shared unknowns, and of unknowns in each.
  [[nodiscard]] std::size_t group_count() const {
    return has_rolling_shutter() ? 1 : projectors_.count;
  }
  [[nodiscard]] std::size_t group_size() const { return has_rolling_shutter() ? 1 : 6; }

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
  [[nodiscard]] std::optional<std::size_t> group_of(std::size_t view) const {
    return has_rolling_shutter() ? std::optional<std::size_t>(0) : projectors_.of(view);
  }
  [[nodiscard]] SharedVector shared_jacobian(std::size_t datum, const Vec3& gradient_sensor) const;
  [[nodiscard]] double weight_of(const ResidualSize& size, double spread) const;

  const JointRefineOptions& options_;
  const Workers& workers_;
  std::vector<Datum> data_;
  double cell_mm_ = 0.0;
  MovedProjectors projectors_;
  std::vector<double> row_shares_;  ///< by datum; empty: no rolling shutter
  std::vector<Twist> velocities_;   ///< of the sensor, by view
  double readout_s_ = 0.0;
  std::vector<Vec3> measured_mm_;  ///< positions of the data as measured, if they can move
};

}  // namespace flytri::refinement
