#include "core/calibration/fit/least_squares.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/median.h"
#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

/// Rejects only one Gaussian value in about two million; a wrong dot number or dirt on the plane is
/// much farther away.
constexpr double kOutlierSigmas = 5.0;

std::vector<Eigen::Index> inliers(const Eigen::VectorXd& residuals) {
  std::vector<double> sizes(static_cast<std::size_t>(residuals.size()));
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    sizes[static_cast<std::size_t>(i)] = std::abs(residuals[i]);
  }
  const double limit = kOutlierSigmas * kSigmaOfMedian * median_of(sizes) + 1e-12;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    if (std::abs(residuals[i]) <= limit) kept.push_back(i);
  }
  return kept;
}

struct Solution {
  Eigen::VectorXd coefficients;
  FitResidual residual;
};

/// Solves rows * x = values; then again without outliers.
Result<Solution> solve_robustly(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values) {
  if (rows.rows() < 2 * rows.cols()) {
    return fail(ErrorCode::kInsufficient, "{} points are too few for {} coefficients", rows.rows(),
                rows.cols());
  }
  const Eigen::VectorXd first = solve_least_squares(rows, values).x;
  const auto kept = inliers(values - rows * first);
  const Eigen::MatrixXd kept_rows = rows(kept, Eigen::seqN(0, rows.cols()));
  const Eigen::VectorXd kept_values = values(kept);
  const LeastSquares fit = solve_least_squares(kept_rows, kept_values);
  if (fit.rank < rows.cols()) {
    return fail(ErrorCode::kInsufficient, "the points do not determine all {} coefficients",
                rows.cols());
  }
  Solution solution{fit.x, {}};
  const Eigen::VectorXd residuals = kept_values - kept_rows * solution.coefficients;
  solution.residual.count = residuals.size();
  solution.residual.rms = std::sqrt(residuals.squaredNorm() / static_cast<double>(kept.size()));
  solution.residual.max = residuals.cwiseAbs().maxCoeff();
  return solution;
}

/// Center and half range of a variable over the data; a constant variable gets half range 1.
template <typename Datum>
std::pair<double, double> range_of(const std::vector<Datum>& data,
                                   const std::function<double(const Datum&)>& variable) {
  double low = variable(data.front()), high = low;
  for (const Datum& datum : data) {
    low = std::min(low, variable(datum));
    high = std::max(high, variable(datum));
  }
  return {0.5 * (low + high), high > low ? 0.5 * (high - low) : 1.0};
}

Eigen::VectorXd powers(double t, int degree) {
  Eigen::VectorXd result(degree + 1);
  result[0] = 1.0;
  for (int i = 1; i <= degree; ++i) result[i] = result[i - 1] * t;
  return result;
}

}  // namespace

Eigen::VectorXd LineSurface::row(double along_px) const {
  return coefficients * powers((along_px - along_center) / along_half_range, along_degree);
}

double LineSurface::operator()(double across_px, double along_px) const {
  return powers((across_px - across_center) / across_half_range, across_degree).dot(row(along_px));
}

Result<LineSurface> fit_surface(const std::vector<SurfaceDatum>& data, int across_degree,
                                int along_degree) {
  if (data.empty()) return fail(ErrorCode::kInsufficient, "there are no points to fit");
  LineSurface surface;
  surface.across_degree = across_degree;
  surface.along_degree = along_degree;
  std::tie(surface.across_center, surface.across_half_range) =
      range_of<SurfaceDatum>(data, [](const SurfaceDatum& d) { return d.across_px; });
  std::tie(surface.along_center, surface.along_half_range) =
      range_of<SurfaceDatum>(data, [](const SurfaceDatum& d) { return d.along_px; });

  const int terms = (across_degree + 1) * (along_degree + 1);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(data.size()), terms);
  Eigen::VectorXd values(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const SurfaceDatum& d = data[static_cast<std::size_t>(i)];
    const Eigen::VectorXd across =
        powers((d.across_px - surface.across_center) / surface.across_half_range, across_degree);
    const Eigen::VectorXd along =
        powers((d.along_px - surface.along_center) / surface.along_half_range, along_degree);
    const Eigen::MatrixXd product = across * along.transpose();
    rows.row(i) = product.reshaped().transpose();
    values[i] = d.value;
  }
  auto solution = solve_robustly(rows, values);
  if (!solution) return tl::unexpected(solution.error());
  surface.coefficients = solution->coefficients.reshaped(across_degree + 1, along_degree + 1);
  surface.residual = solution->residual;
  return surface;
}

Result<TrivariateCubic> fit_cubic(const std::vector<CubicDatum>& data) {
  if (data.empty()) return fail(ErrorCode::kInsufficient, "there are no points to fit");
  TrivariateCubic cubic;
  for (int axis = 0; axis < 3; ++axis) {
    std::tie(cubic.center[axis], cubic.half_range[axis]) =
        range_of<CubicDatum>(data, [axis](const CubicDatum& d) { return d.at[axis]; });
  }
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(data.size()), TrivariateCubic::kTerms);
  Eigen::VectorXd values(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const CubicDatum& d = data[static_cast<std::size_t>(i)];
    const Vec3 t = (d.at - cubic.center).cwiseQuotient(cubic.half_range);
    for (int term = 0; term < TrivariateCubic::kTerms; ++term) {
      const auto& e = TrivariateCubic::kExponents[static_cast<std::size_t>(term)];
      rows(i, term) = std::pow(t[0], e[0]) * std::pow(t[1], e[1]) * std::pow(t[2], e[2]);
    }
    values[i] = d.value;
  }
  const auto solution = solve_robustly(rows, values);
  if (!solution) return tl::unexpected(solution.error());
  Eigen::VectorXd::Map(cubic.coefficients.data(), TrivariateCubic::kTerms) = solution->coefficients;
  cubic.residual = solution->residual;
  return cubic;
}

}  // namespace flytri::calibration
