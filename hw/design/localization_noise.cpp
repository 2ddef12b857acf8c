#include "hw/design/localization_noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace flytri::design {
namespace {

using simulated::ChipModel;

// The fit uses pixels up to this far from the middle, core/localization/refine_traces.cpp.
constexpr double kReachSigmas = 4.0;
constexpr double kFullScale8 = 255.0;
// The fit estimates background, width and noise model from the same image, which linear propagation
// leaves out. Measured on the simulated sensor, 1.07 to 1.25 in twelve cases:
// tests/unit/hw/design/design_accuracy_test.cpp.
constexpr double kEstimatedToo = 1.17;

// Variance without speckle, share of full scale squared.
double pixel_variance(const ChipModel& chip, double light) {
  const double read = chip.read_noise_e / chip.full_well_e;
  const double rounding = 1.0 / kFullScale8;
  return read * read + (light + chip.ambient_level) / chip.full_well_e + rounding * rounding / 12.0;
}

// Of two pixels of a row, see Chip.
double speckle_correlation(const ChipModel& chip, double distance_px) {
  return std::exp(-std::pow(distance_px / chip.speckle_size_px, 2));
}

Eigen::MatrixXd covariance(const ChipModel& chip, const Eigen::VectorXd& light) {
  const double contrast2 = chip.speckle_contrast * chip.speckle_contrast;
  Eigen::MatrixXd K(light.size(), light.size());
  for (Eigen::Index i = 0; i < light.size(); ++i)
    for (Eigen::Index j = 0; j < light.size(); ++j) {
      const auto distance_px = static_cast<double>(i - j);
      K(i, j) = contrast2 * light[i] * light[j] * speckle_correlation(chip, distance_px);
      if (i == j) K(i, j) += pixel_variance(chip, light[i]);
    }
  return K;
}

// Weight of a pixel in the fit.
double pixel_weight(const ChipModel& chip, const FittedLine& line, double offset_px) {
  const double reach_px = kReachSigmas * line.sigma_px;
  const double taper = std::max(1.0 - std::pow(offset_px / reach_px, 2), 0.0);
  const double signal = line(offset_px);
  const double speckle = chip.speckle_contrast * signal;
  return taper * taper / (pixel_variance(chip, signal) + speckle * speckle);
}

// One step of Gauss and Newton for height and width.
FittedLine improved(const LineLight& light, const FittedLine& line, const ChipModel& chip) {
  constexpr double kStep_px = 0.25;
  const double reach_px = kReachSigmas * line.sigma_px;
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (double offset_px = 0.0; offset_px < reach_px; offset_px += kStep_px) {
    const double t = offset_px / line.sigma_px;
    const double value = line(offset_px);
    const Eigen::Vector2d J(value / line.height, value * t * t / line.sigma_px);
    const double weight = pixel_weight(chip, line, offset_px);
    H += weight * J * J.transpose();
    b += weight * (light(offset_px) - value) * J;
  }
  const double determinant = H(0, 0) * H(1, 1) - H(0, 1) * H(0, 1);
  return {line.height + (H(1, 1) * b[0] - H(0, 1) * b[1]) / determinant,
          line.sigma_px + (H(0, 0) * b[1] - H(0, 1) * b[0]) / determinant};
}

// Variance for a line whose middle lies `phase_px` beside the middle of a pixel.
double variance_at(const LineLight& light, const FittedLine& line, int half_px,
                   const ChipModel& chip, double phase_px) {
  constexpr double kStep_px = 1e-3;
  const auto reach_px = static_cast<int>(std::ceil(kReachSigmas * line.sigma_px));
  const int middle = std::max(half_px, reach_px), count = 2 * middle + 1;
  Eigen::VectorXd values(count), slopes(count), weights(count);
  for (int i = 0; i < count; ++i) {
    const double offset_px = static_cast<double>(i - middle) - phase_px;
    values[i] = light(offset_px);
    slopes[i] = (light(offset_px - kStep_px) - light(offset_px + kStep_px)) / (2.0 * kStep_px);
    weights[i] = pixel_weight(chip, line, offset_px) * line(offset_px) * offset_px;
  }
  const double response = weights.dot(slopes);
  return weights.dot(covariance(chip, values) * weights) / (response * response);
}

}  // namespace

FittedLine fit_line_light(const LineLight& light, double width_px, const ChipModel& chip) {
  constexpr int kSteps = 8;
  FittedLine line{light(0.0), width_px / kWidthPerSigma};
  for (int step = 0; step < kSteps; ++step) line = improved(light, line, chip);
  return line;
}

double localization_deviation_px(const LineLight& light, const FittedLine& line, int half_px,
                                 const ChipModel& chip) {
  constexpr int kPhases = 4;
  double sum = 0.0;
  for (int i = 0; i < kPhases; ++i)
    sum += variance_at(light, line, half_px, chip, (i + 0.5) / kPhases - 0.5);
  return kEstimatedToo * std::sqrt(sum / kPhases);
}

}  // namespace flytri::design
