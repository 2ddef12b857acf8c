/// @file  How exactly a line can be located in an image with speckle, shot and read noise.
#pragma once

#include <cmath>
#include <functional>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::design {

/// Light across a line, share of full scale, by the distance from its middle in pixels. Symmetric.
using LineLight = std::function<double(double)>;

/// Full width at half maximum of a Gaussian, by its standard deviation.
inline constexpr double kWidthPerSigma = 2.3548200450309493;

/// The Gaussian that the weighted fit (core/localization/fit_line.h) finds in a line.
struct FittedLine {
  double height = 0.0;
  double sigma_px = 0.0;
  [[nodiscard]] double operator()(double offset_px) const {
    const double t = offset_px / sigma_px;
    return height * std::exp(-0.5 * t * t);
  }
};

/// @param width_px  full width at half maximum of the light: where the fit begins
[[nodiscard]] FittedLine fit_line_light(const LineLight& light, double width_px,
                                        const simulated::ChipModel& chip);

/// Standard uncertainty of the weighted fit in one row of an 8-bit image: the noise of all pixels,
/// with the correlation of speckle between neighbors, weighted as the fit weights them.
///
/// With the weights w, the slope g of the Gaussian, the slope s of the light and the covariance K
/// of the pixels, the shift is linear in small noise: variance = a^T K a / (a^T s)^2, a = w g.
/// A measured factor stands for what the fit estimates besides.
/// @param half_px  the light is 0 farther from the middle
[[nodiscard]] double localization_deviation_px(const LineLight& light, const FittedLine& line,
                                               int half_px, const simulated::ChipModel& chip);

}  // namespace flytri::design
