/// @file  How uncertain a gray value is: reading, counting and speckle.
#pragma once

namespace flytri::localization {

/// Variance of a pixel that shows `signal` above the background.
/// Reading noise (with the background's own shot noise) does not depend on the signal, shot noise
/// grows with it, speckle with its square.
struct NoiseModel {
  float read_variance = 1.0F;     ///< gray values squared
  float shot_gain = 0.0F;         ///< gray values a photoelectron
  float speckle_contrast = 0.0F;  ///< relative

  [[nodiscard]] float variance(float signal) const {
    const float speckle = speckle_contrast * signal;
    return read_variance + shot_gain * signal + speckle * speckle;
  }
};

}  // namespace flytri::localization
