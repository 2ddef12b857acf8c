#include "core/refinement/joint_equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/median.h"
#include "core/geometry/point_spacing.h"
#include "core/refinement/sheet_shift.h"

namespace flytri::refinement {
namespace {

/// Default edge of a cell in spacings of neighboring points.
constexpr double kCellSpacings = 16.0;
/// Length of a profile that becomes one datum, as a share of a cell's edge.
constexpr double kDatumShare = 0.2;
/// If a smaller share of the data is in cells with a surface, the cells are enlarged by this
/// factor, up to this many times.
constexpr double kMinValidShare = 0.5;
constexpr double kEnlargement = 1.5;
constexpr int kMaxEnlargements = 3;

double robust_sigma_of(std::vector<double>& sizes) {
  return sizes.empty() ? 0.0 : kSigmaOfMedian * median_of(sizes);
}

void measure_spread(FittedSurfaces& surfaces, const Workers& workers) {
  std::vector<double> normalized;
  std::vector<double> plain;
  for (const auto& cell : surfaces.residuals) {
    for (const ResidualSize& r : cell) {
      if (!r.usable) continue;
      normalized.push_back(std::abs(r.residual_mm) / r.sigma_mm);
      plain.push_back(std::abs(r.residual_mm));
    }
  }
  workers.for_each(2, [&](std::size_t i) {
    if (i == 0) surfaces.spread = std::max(robust_sigma_of(normalized), 1e-12);
    if (i == 1) surfaces.robust_sigma_mm = robust_sigma_of(plain);
  });
}

/// Share of the data that lies in cells with a surface.
double valid_share(const FittedSurfaces& surfaces) {
  std::size_t valid = 0;
  std::size_t all = 0;
  for (const SurfaceCell& cell : surfaces.cells) {
    all += cell.data.size();
    if (cell.valid) valid += cell.data.size();
  }
  return all == 0 ? 0.0 : static_cast<double>(valid) / static_cast<double>(all);
}

/// Sums over one cell and view, for the group of shared unknowns that it depends on.
struct SharedSums {
  SharedSums(std::size_t index, Eigen::Index size)
      : group(index),
        SA(SharedMatrix::Zero(size, 6)),
        JS(SharedMatrix::Zero(6, size)),
        SS(SharedMatrix::Zero(size, size)),
        Sr(SharedVector::Zero(size)) {}

  std::size_t group;
  SharedMatrix SA, JS, SS;
  SharedVector Sr;
};

/// Sums over one cell, by view.
struct CellSums {
  struct ViewSums {
    std::uint32_t view = 0;
    Matrix6 JJ = Matrix6::Zero();
    Matrix6 JA = Matrix6::Zero();
    Twist Jr = Twist::Zero();
    std::unique_ptr<SharedSums> shared = nullptr;
  };
  std::vector<ViewSums> views;  ///< by rising view
  Matrix6 AA = Matrix6::Zero();
  Quadric Ar = Quadric::Zero();
};

/// Eliminates the cell's surface. Empty if only one view saw it, or its inliers do not determine
/// the surface.
std::vector<CellViewShare> without_surface(const CellSums& sums) {
  if (sums.views.size() < 2) return {};
  const Eigen::LLT<Matrix6> cholesky(sums.AA);
  if (cholesky.info() != Eigen::Success || cholesky.rcond() < 1e-9) return {};
  const Quadric LAr = cholesky.matrixL().solve(sums.Ar);
  std::vector<CellViewShare> shares;
  shares.reserve(sums.views.size());
  for (const auto& of_view : sums.views) {
    CellViewShare share;
    share.block.view = of_view.view;
    share.block.coupling = cholesky.matrixL().solve(of_view.JA.transpose()).transpose();
    share.information = of_view.JJ;
    share.gradient = of_view.Jr - share.block.coupling * LAr;
    if (const auto& shared = of_view.shared) {
      const SharedMatrix coupling =
          cholesky.matrixL().solve(Eigen::MatrixXd(shared->SA.transpose())).transpose();
      share.shared = std::make_unique<CellSharedShare>(CellSharedShare{
          shared->group, coupling, shared->JS, shared->SS, shared->Sr - coupling * LAr});
    }
    shares.push_back(std::move(share));
  }
  return shares;
}

}  // namespace

void add_to(ReducedSystem& system, std::span<const CellViewShare> shares) {
  for (const CellViewShare& share : shares) {
    system.add_view(share.block.view, share.information, share.gradient);
    system.add_block(share.block);
  }
  system.end_cell();
}

JointEquations::JointEquations(std::span<const AlignedView> views,
                               const JointRefineOptions& options, const Workers& workers)
    : options_(options), workers_(workers) {
  cell_mm_ =
      options.cell_mm > 0.0 ? options.cell_mm : kCellSpacings * median_point_spacing_mm(views);
  if (cell_mm_ > 0.0) data_ = gather_data(views, kDatumShare * cell_mm_, workers);
}

void JointEquations::set_projectors(MovedProjectors projectors) {
  projectors_ = std::move(projectors);
  measured_mm_.clear();
  for (const Datum& datum : data_) measured_mm_.push_back(datum.position_mm);
}

void JointEquations::move_projectors(std::span<const Twist> motions) {
  for (std::size_t i = 0; i < data_.size(); ++i) {
    const auto moved = projectors_.of(data_[i].view.at());
    if (!moved) continue;
    data_[i].position_mm =
        seen_with(motions[*moved], measured_mm_[i], data_[i].sheet_normal, projectors_.p_camera_mm);
  }
}

void JointEquations::set_rolling_shutter(const trajectory::RowShare& row_share) {
  measured_mm_.clear();
  for (const Datum& datum : data_) {
    measured_mm_.push_back(datum.position_mm);
    row_shares_.push_back(row_share(datum.position_mm));
  }
}

void JointEquations::move_rows(std::span<const Twist> velocities, double readout_s) {
  velocities_.assign(velocities.begin(), velocities.end());
  readout_s_ = readout_s;
  for (std::size_t i = 0; i < data_.size(); ++i) {
    data_[i].position_mm = trajectory::seen_late(velocities_[data_[i].view.at()],
                                                 readout_s * row_shares_[i], measured_mm_[i]);
  }
}

/// Of the residual with this gradient by position, sensor frame.
SharedVector JointEquations::shared_jacobian(std::size_t i, const Vec3& gradient_sensor) const {
  const Datum& datum = data_[i];
  if (has_rolling_shutter()) {
    const Vec3 per_s = trajectory::seen_late_derivative(
        velocities_[datum.view.at()], readout_s_ * row_shares_[i], datum.position_mm);
    return SharedVector::Constant(1, row_shares_[i] * gradient_sensor.dot(per_s));
  }
  const SheetShift shift =
      sheet_shift(measured_mm_[i], datum.sheet_normal, projectors_.p_camera_mm);
  return gradient_sensor.dot(shift.ray) * shift.per_twist;
}

double JointEquations::mean_radius_mm() const {
  if (data_.empty()) return 1.0;
  double sum = 0.0;
  for (const Datum& datum : data_) sum += datum.position_mm.norm();
  return sum / static_cast<double>(data_.size());
}

std::vector<Vec3> JointEquations::view_centers_mm(std::span<const Isometry> poses) const {
  std::vector<Vec3> centers(poses.size(), Vec3::Zero());
  std::vector<double> counts(poses.size(), 0.0);
  for (const Datum& datum : data_) {
    centers[datum.view.at()] += datum.position_mm;
    counts[datum.view.at()] += 1.0;
  }
  for (std::size_t v = 0; v < centers.size(); ++v) {
    centers[v] = poses[v] * Vec3(centers[v] / std::max(counts[v], 1.0));
  }
  return centers;
}

Result<FittedSurfaces> JointEquations::fit_surfaces_of(std::span<const Isometry> poses,
                                                       double cell_mm,
                                                       const Progress& progress) const {
  FittedSurfaces surfaces{cell_mm, divide_space(data_, poses, cell_mm, workers_), {}, 1.0, 0.0};
  surfaces.residuals.resize(surfaces.cells.size());
  const auto fit = [&](std::size_t c) {
    SurfaceCell& cell = surfaces.cells[c];
    fit_surface(cell, data_, poses, cell_mm);
    if (!cell.valid) return;
    surfaces.residuals[c].reserve(cell.data.size());
    for (const std::uint32_t i : cell.data) {
      const SurfaceResidual r = residual_of(cell, data_[i], poses[data_[i].view.at()], cell_mm);
      surfaces.residuals[c].push_back({r.residual_mm, r.sigma_mm, r.usable});
    }
  };
  if (!workers_.for_each_unless_cancelled(surfaces.cells.size(), fit, progress)) return stopped();
  measure_spread(surfaces, workers_);
  return surfaces;
}

Result<FittedSurfaces> JointEquations::fit_surfaces(std::span<const Isometry> poses,
                                                    const Progress& progress) const {
  double cell_mm = cell_mm_;
  auto surfaces = fit_surfaces_of(poses, cell_mm, progress);
  for (int i = 0; i < kMaxEnlargements && surfaces && valid_share(*surfaces) < kMinValidShare;
       ++i) {
    cell_mm *= kEnlargement;
    // The repetition was not planned, so it does not advance the progress.
    surfaces = fit_surfaces_of(poses, cell_mm, progress.part(0.0));
  }
  return surfaces;
}

/// 0 if the residual does not count.
double JointEquations::weight_of(const ResidualSize& size, double spread) const {
  if (!size.usable) return 0.0;
  // While the poses are wrong, the residuals are larger than the noise.
  const double sigma_mm = spread * size.sigma_mm;
  return tukey_weight(size.residual_mm / sigma_mm, options_.tukey_sigmas) / (sigma_mm * sigma_mm);
}

std::vector<CellViewShare> JointEquations::sum_cell(const FittedSurfaces& surfaces, std::size_t c,
                                                    std::span<const Isometry> poses,
                                                    std::span<const Vec3> centers_mm) const {
  const SurfaceCell& cell = surfaces.cells[c];
  CellSums sums;
  for (std::size_t k = 0; k < surfaces.residuals[c].size(); ++k) {
    const ResidualSize& size = surfaces.residuals[c][k];
    const double weight = weight_of(size, surfaces.spread);
    if (weight == 0.0) continue;
    const Datum& datum = data_[cell.data[k]];
    const auto view = static_cast<std::uint32_t>(datum.view.value);
    const SurfaceResidual r = residual_of(cell, datum, poses[view], surfaces.cell_mm);
    // Data are sorted by view.
    if (sums.views.empty() || sums.views.back().view != view) {
      sums.views.push_back({view});
      if (const auto group = group_of(view))
        sums.views.back().shared =
            std::make_unique<SharedSums>(*group, static_cast<Eigen::Index>(group_size()));
    }
    auto& of_view = sums.views.back();
    Twist J;
    J << (r.foot_mm - centers_mm[view]).cross(r.gradient), r.gradient;
    of_view.JJ.noalias() += weight * J * J.transpose();
    of_view.JA.noalias() += weight * J * r.terms.transpose();
    of_view.Jr += weight * r.residual_mm * J;
    if (auto& shared = of_view.shared) {
      const SharedVector S =
          shared_jacobian(cell.data[k], poses[view].linear().transpose() * r.gradient);
      shared->SS.noalias() += weight * S * S.transpose();
      shared->SA.noalias() += weight * S * r.terms.transpose();
      shared->JS.noalias() += weight * J * S.transpose();
      shared->Sr += weight * r.residual_mm * S;
    }
    sums.AA.noalias() += weight * r.terms * r.terms.transpose();
    sums.Ar += weight * r.residual_mm * r.terms;
  }
  return without_surface(sums);
}

bool JointEquations::sum_cells(const FittedSurfaces& surfaces, std::span<const Isometry> poses,
                               std::span<const Vec3> centers_mm, const Progress& progress,
                               const TakeCell& take) const {
  constexpr std::size_t kBlock = 1024;
  std::vector<std::vector<CellViewShare>> shares(kBlock);
  const std::size_t count = surfaces.cells.size();
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    const Progress of_block = progress.part(static_cast<double>(size) / static_cast<double>(count));
    const auto sum = [&](std::size_t i) {
      shares[i] = sum_cell(surfaces, begin + i, poses, centers_mm);
    };
    if (!workers_.for_each_unless_cancelled(size, sum, of_block)) return false;
    for (std::size_t i = 0; i < size; ++i) {
      if (!shares[i].empty()) take(begin + i, shares[i]);
    }
  }
  return true;
}

std::map<std::uint32_t, Matrix6> JointEquations::information_near(const FittedSurfaces& surfaces,
                                                                  std::span<const Isometry> poses,
                                                                  const Vec3& p_mm,
                                                                  double radius_mm) const {
  std::map<std::uint32_t, Matrix6> by_view;
  for (std::size_t c = 0; c < surfaces.cells.size(); ++c) {
    const SurfaceCell& cell = surfaces.cells[c];
    // The origin is the mean of the data of a cube.
    if (!cell.valid || (cell.origin_mm - p_mm).norm() > radius_mm + 2.0 * surfaces.cell_mm) {
      continue;
    }
    for (std::size_t k = 0; k < surfaces.residuals[c].size(); ++k) {
      const double weight = weight_of(surfaces.residuals[c][k], surfaces.spread);
      if (weight == 0.0) continue;
      const Datum& datum = data_[cell.data[k]];
      const Isometry& T_world_sensor = poses[datum.view.at()];
      if ((T_world_sensor * datum.position_mm - p_mm).norm() > radius_mm) continue;
      const SurfaceResidual r = residual_of(cell, datum, T_world_sensor, surfaces.cell_mm);
      Twist J;
      J << (r.foot_mm - p_mm).cross(r.gradient), r.gradient;
      by_view.try_emplace(static_cast<std::uint32_t>(datum.view.value), Matrix6::Zero())
          .first->second += weight * J * J.transpose();
    }
  }
  return by_view;
}

double JointEquations::step_factor(const FittedSurfaces& surfaces) const {
  double weights = 0.0;
  double slopes = 0.0;
  const double limit = options_.tukey_sigmas * surfaces.spread;
  for (const auto& cell : surfaces.residuals) {
    for (const ResidualSize& r : cell) {
      const double u = r.usable ? r.residual_mm / (limit * r.sigma_mm) : 1.0;
      if (u * u >= 1.0) continue;
      // Of the weighted residual u (1 - u^2)^2.
      weights += (1.0 - u * u) * (1.0 - u * u);
      slopes += (1.0 - u * u) * (1.0 - 5.0 * u * u);
    }
  }
  // Far from the solution many residuals are near the limit.
  constexpr double kLargest = 2.0;
  return slopes * kLargest > weights ? weights / slopes : kLargest;
}

std::size_t JointEquations::count_views_of_cells(const FittedSurfaces& surfaces) const {
  std::size_t count = 0;
  for (const SurfaceCell& cell : surfaces.cells) {
    if (!cell.valid) continue;
    for (std::size_t k = 0; k < cell.data.size(); ++k) {
      if (k == 0 || data_[cell.data[k]].view != data_[cell.data[k - 1]].view) ++count;
    }
  }
  return count;
}

}  // namespace flytri::refinement
