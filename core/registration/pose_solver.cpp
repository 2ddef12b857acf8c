#include "core/registration/pose_solver.h"

#include <algorithm>
#include <cmath>

#include "core/base/median.h"
#include "core/geometry/decompositions.h"

namespace flytri::registration {
namespace {

using Matrix63 = Eigen::Matrix<double, 6, 3>;

/// Uncertainty of a profile's direction. Smaller than SmoothingOptions::max_direction_noise_rad,
/// because directions use a window twice as wide.
constexpr double kNormalNoise_rad = 0.03;
/// The same by the noise that the points show: on planes, at correlations of 1.5 samples, normals
/// scatter by 0.047 rad where points scatter 1.85 times as much as expected.
constexpr double kNoisyNormals = 0.047 / 1.85 / kNormalNoise_rad;
/// A direction is open if what is left for structure is less than this share of the noise.
constexpr double kOpenShare = 0.1;
/// A residual of this many robust sigmas has a quarter of the weight.
constexpr double kRobustWidth = 3.0;

/// Robust standard deviation of the residuals divided by their expected uncertainty, at least 1.
double noise_scale(std::span<const Crossing> crossings) {
  std::vector<double> ratios;
  ratios.reserve(crossings.size());
  for (const Crossing& c : crossings) ratios.push_back(std::abs(c.distance_mm) / c.sigma_mm);
  return std::max(1.0, median_of(ratios) / kMedianOfSigma);
}

/// Derivative of the source point p with respect to the unknowns.
Matrix63 motion_jacobian(const Vec3& p_mm, const StepFrame& frame) {
  const Vec3 arm = (p_mm - frame.center_mm) / frame.radius_mm;
  Matrix63 J;
  J.topRows<3>() << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  J.bottomRows<3>().setIdentity();
  return J;
}

double robust_weight(const Crossing& c, double scale) {
  const double u = c.distance_mm / (kRobustWidth * scale * c.sigma_mm);
  return 1.0 / ((1.0 + u * u) * (1.0 + u * u));
}

/// Normal equations of all crossings, in units of the noise.
struct Equations {
  Matrix6 H = Matrix6::Zero();
  Matrix6 from_normal_noise =
      Matrix6::Zero();  ///< part of H that is caused only by noise of the normals
  Twist g = Twist::Zero();

  void add(const Crossing& c, double weight, const StepFrame& frame, ResidualKind kind) {
    const Matrix63 A = motion_jacobian(c.q_mm, frame);
    if (kind == ResidualKind::kPointToPoint) {
      H.noalias() += weight * A * A.transpose();
      g.noalias() += weight * A * (c.p_mm - c.q_mm);
      return;
    }
    const Twist J = A * c.normal;
    H.noalias() += weight * J * J.transpose();
    g += weight * c.distance_mm * J;
    from_normal_noise.noalias() +=
        weight * kNormalNoise_rad * kNormalNoise_rad * (A * A.transpose() - J * J.transpose());
  }
};

double base_weight(const Crossing& c, CrossingWeight kind, double mean_variation_mm) {
  const double by_noise = 1.0 / (c.sigma_mm * c.sigma_mm);
  if (kind == CrossingWeight::kUncertainty) return by_noise;
  return by_noise * c.depth_variation_mm / mean_variation_mm;
}

void describe_fit(std::span<const Crossing> crossings, PoseStep& step) {
  double squares = 0.0;
  std::size_t inliers = 0;
  for (const Crossing& c : crossings) {
    if (std::abs(c.distance_mm) > 3.0 * step.noise_scale * c.sigma_mm) continue;
    squares += c.distance_mm * c.distance_mm;
    ++inliers;
  }
  step.inlier_share = static_cast<double>(inliers) / static_cast<double>(crossings.size());
  step.rms_mm = std::sqrt(squares / std::max<double>(1.0, static_cast<double>(inliers)));
}

Twist prior_information(const PosePrior& prior, const StepFrame& frame) {
  Twist information;
  information.head<3>().setConstant(1.0 / std::pow(prior.rotation_rad * frame.radius_mm, 2));
  information.tail<3>().setConstant(1.0 / std::pow(prior.translation_mm, 2));
  return information;
}

}  // namespace

PoseStep solve_step(std::span<const Crossing> crossings, const StepFrame& frame,
                    const Twist& moved_mm, const StepOptions& options) {
  PoseStep step;
  if (crossings.empty()) return step;
  step.noise_scale = noise_scale(crossings);
  describe_fit(crossings, step);

  double mean_variation = 1e-12;
  for (const Crossing& c : crossings) {
    mean_variation += c.depth_variation_mm / static_cast<double>(crossings.size());
  }
  Equations equations;
  for (const Crossing& c : crossings) {
    const double weight = base_weight(c, options.weight, mean_variation) *
                          robust_weight(c, step.noise_scale) /
                          (step.noise_scale * step.noise_scale);
    equations.add(c, weight, frame, options.residual);
  }

  const auto eigen = symmetric_eigen(equations.H);
  Matrix6 P = options.known.value_or(prior_information(options.prior, frame).asDiagonal());
  Twist g_by_information = Twist::Zero();
  for (int i = 0; i < 6; ++i) {
    const Twist v = eigen.vectors.col(i);
    const double from_normal_noise = v.dot(equations.from_normal_noise * v);
    const double known = eigen.values[i] - from_normal_noise;
    step.sigma_mm[i] = known > 0.0 ? 1.0 / std::sqrt(known) : 1e30;
    if (known < 2.0 * from_normal_noise && !options.known) {
      P += 10.0 * eigen.values[i] * v * v.transpose();
    }
    // Where the points are noisier than expected, so are the normals.
    const double from_all_noise = std::pow(kNoisyNormals * step.noise_scale, 2) * from_normal_noise;
    const double certain = eigen.values[i] - from_all_noise;
    step.is_open |= certain < kOpenShare * from_all_noise;
    // The noise of the normals adds to the variance of the gradient, but not to its slope.
    const double slope_share = certain > 0.0 ? certain / eigen.values[i] : 0.0;
    step.information += slope_share * certain * v * v.transpose();
    g_by_information += slope_share * v.dot(equations.g) * v;
  }
  const Matrix6 total = (options.known ? step.information : equations.H) + P;
  step.motion_mm =
      -solve_symmetric(total, (options.known ? g_by_information : equations.g) + P * moved_mm);
  step.significance = std::sqrt(step.motion_mm.dot(total * step.motion_mm));
  return step;
}

double worst_sigma_mm(const Matrix6& information) {
  const double least = symmetric_eigen(information).values[0];
  return least > 0.0 ? 1.0 / std::sqrt(least) : 1e30;
}

Isometry motion_of(const Twist& motion_mm, const StepFrame& frame) {
  Twist twist = motion_mm;
  twist.head<3>() /= frame.radius_mm;
  const Isometry about_center = exp_twist(twist);
  return Eigen::Translation3d(frame.center_mm) * about_center *
         Eigen::Translation3d(-frame.center_mm);
}

Twist unknowns_of(const Isometry& T_moved, const StepFrame& frame) {
  const Isometry about_center =
      Eigen::Translation3d(-frame.center_mm) * T_moved * Eigen::Translation3d(frame.center_mm);
  Twist twist = log_twist(about_center);
  twist.head<3>() *= frame.radius_mm;
  return twist;
}

}  // namespace flytri::registration
