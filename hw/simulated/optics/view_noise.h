/// @file  Adds noise to a view: white, correlated along the line, or as it was measured.
#pragma once

#include <cstdint>
#include <memory>

#include "core/base/result.h"
#include "core/geometry/view.h"
#include "hw/simulated/optics/measured_noise.h"

namespace flytri::simulated {

/// Noise of single points, as in the paper's simulation toolbox.
struct ViewNoise {
  /// >= 0, standard deviation along z; default: the paper's intra-oral sensor.
  double sigma_mm = 0.03;
  /// >= 0. Correlation of the noise along a line: white noise is smoothed by a Gaussian with this
  /// standard deviation in samples, then scaled to `sigma_mm`. 0: white noise.
  double correlation_samples = 0.0;
  std::uint64_t seed = 1;
  /// If given, noise is drawn from it; then `sigma_mm` and `correlation_samples` are not used.
  std::shared_ptr<const MeasuredNoise> measured = nullptr;
  [[nodiscard]] Result<void> validate() const;
};

/// A copy of `ideal` with each point moved along z. Points, profiles and their order are the same,
/// so that errors can be computed point by point. Equal `stream` and seed give equal noise.
[[nodiscard]] View add_noise(const View& ideal, const ViewNoise& noise, std::uint64_t stream);

}  // namespace flytri::simulated
