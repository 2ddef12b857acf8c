/// @file  The brightness across a projected line, depending on defocus.
#pragma once

#include <cmath>
#include <vector>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Light of a slit of unit brightness behind a thin lens: a box, blurred by the defocus disk and by
/// diffraction. All lengths are tangents on the slide. Immutable.
class LineProfile {
 public:
  /// @param max_blur  largest disk radius that will be used
  LineProfile(const ProjectorModel& projector, double max_blur);

  /// Brightness at `offset` from the line's middle with a blur disk of radius `blur`. The integral
  /// over the offset is always the slit's width.
  [[nodiscard]] double operator()(double offset, double blur) const;
  /// The profile for one blur radius, for fast evaluation at many offsets.
  class Section {
   public:
    [[nodiscard]] float operator()(float offset) const {
      const float x = std::abs(offset) * steps_;
      if (x >= last_) return 0.0F;
      const int j = static_cast<int>(x);
      const float tx = x - static_cast<float>(j);
      return (1.0F - ty_) * (near_[j] + tx * (near_[j + 1] - near_[j])) +
             ty_ * (far_[j] + tx * (far_[j + 1] - far_[j]));
    }

   private:
    friend class LineProfile;
    const float* near_;  // table row of the next smaller blur
    const float* far_;   // table row of the next larger blur
    float ty_, steps_, last_;
  };
  /// Valid while the profile exists.
  [[nodiscard]] Section section(double blur) const;

  /// Largest offset with light.
  [[nodiscard]] double reach(double blur) const { return half_width_ + blur + kSigmas * sigma_; }

 private:
  static constexpr double kSigmas = 3.0;
  double compute(double offset, double blur) const;

  double half_width_, sigma_;
  double blur_step_, offset_step_;
  std::vector<float> table_;  // [blur][offset]
};

}  // namespace flytri::simulated
