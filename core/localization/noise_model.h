/// @file  Noise model of a gray value: reading noise, shot noise and speckle.
#pragma once

namespace flytri::localization {

/// Variance of a pixel with `signal` above the background. Reading noise (including the
/// background's shot noise) is constant, the variance of shot noise grows with the signal, that of
/// speckle with its square.
struct NoiseModel {
  float read_variance = 1.0F;     ///< gray values squared
  float shot_gain = 0.0F;         ///< gray values per photoelectron
  float speckle_contrast = 0.0F;  ///< relative

  [[nodiscard]] float variance(float signal) const {
    const float speckle = speckle_contrast * signal;
    return read_variance + shot_gain * signal + speckle * speckle;
  }
};

}  // namespace flytri::localization
