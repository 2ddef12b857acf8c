/// @file  Noise as it was measured on planes, and segments of it for the profiles of a view.
///
/// @source  Arold et al., section "Simulation": noise of a sprayed mirror is added to views.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/random.h"
#include "core/base/result.h"
#include "core/geometry/view.h"

namespace flytri::simulated {

/// Measured noise of one sample, along z.
struct NoiseSample {
  float off_mm = 0.0F;
  float stated_mm = 0.0F;  ///< its standard uncertainty, as stated by the localization
};

/// Noise along one line on a plane. Neighbors in the vector were in neighboring rows (vertical
/// pattern) or columns of the image.
struct NoiseSeries {
  Pattern pattern = Pattern::kVertical;
  double z_mm = 0.0;                 ///< of the plane, sensor frame
  std::vector<NoiseSample> samples;  ///< at least 1
};

/// Series of measured noise, by pattern and depth. Immutable and thread-safe.
class MeasuredNoise {
 public:
  /// @errors  kInsufficient: a pattern has no series.
  [[nodiscard]] static Result<MeasuredNoise> create(const std::vector<NoiseSeries>& series);

  /// Noise for the points of a profile, one sample each. It is made of segments of the series from
  /// the plane nearest in depth. Each begins at a random sample, runs in a random direction and has
  /// a random sign. It ends with its series, or where another plane is nearer.
  [[nodiscard]] std::vector<NoiseSample> draw(Pattern pattern, const Profile& profile,
                                              Random& random) const;

  /// All series of the plane nearest in depth.
  [[nodiscard]] const std::vector<std::vector<NoiseSample>>& series_near(Pattern pattern,
                                                                         double z_mm) const {
    return nearest(pattern, z_mm).series;
  }

  /// Depths of the planes, by rising z.
  [[nodiscard]] std::vector<double> depths_mm(Pattern pattern) const;

 private:
  struct Depth {
    double z_mm = 0.0;
    std::vector<std::vector<NoiseSample>> series;
    std::vector<std::size_t> ends;  ///< by series: number of samples up to its end
  };
  [[nodiscard]] const Depth& nearest(Pattern pattern, double z_mm) const;

  std::array<std::vector<Depth>, 2> depths_;  ///< by Pattern, by rising z
};

}  // namespace flytri::simulated
