/// @file  Least-squares polynomials by QR, with one outlier rejection.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "core/calibration/record/calibration.h"

namespace flytri::calibration {

/// One datum of a surface over (across, along): a line's depth or width.
struct SurfaceDatum {
  double across_px = 0.0;
  double along_px = 0.0;
  double value = 0.0;
};

/// A polynomial of degree `across_degree` in `across`, whose coefficients are polynomials of degree
/// `along_degree` in `along`. Both variables are normalized to -1..1.
struct LineSurface {
  int across_degree = 3;
  int along_degree = 0;
  double across_center = 0.0, across_half_range = 1.0;
  double along_center = 0.0, along_half_range = 1.0;
  Eigen::MatrixXd coefficients;  ///< (across power, along power)
  FitResidual residual;

  /// Coefficients of the powers of normalized `across` in one row.
  [[nodiscard]] Eigen::VectorXd row(double along_px) const;
  [[nodiscard]] double operator()(double across_px, double along_px) const;
};

/// Least squares by QR. The second fit ignores data that deviate from the first fit by more than
/// `kOutlierSigmas` robust standard deviations. The residual is that of the used data.
/// @errors  kInsufficient if the data do not determine the coefficients.
[[nodiscard]] Result<LineSurface> fit_surface(const std::vector<SurfaceDatum>& data,
                                              int across_degree, int along_degree);

/// One datum of a trivariate cubic.
struct CubicDatum {
  Vec3 at = Vec3::Zero();
  double value = 0.0;
};

/// Fits a cubic with 20 terms, in the same way as fit_surface.
[[nodiscard]] Result<TrivariateCubic> fit_cubic(const std::vector<CubicDatum>& data);

}  // namespace flytri::calibration
