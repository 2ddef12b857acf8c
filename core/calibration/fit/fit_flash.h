/// @file  Finds the lamp of the texture frames: how bright are white places on the targets?
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/base/workers.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::calibration {

/// What the white of a dot target is taken to reflect. It only sets the brightness of all colors.
inline constexpr double kTargetAlbedo = 0.85;

/// A white place of a target.
struct WhitePlace {
  Vec3 p_sensor;
  Vec3 normal;  ///< unit vector, towards the cameras
};

/// A texture image of a target under the flash.
struct FlashImage {
  cv::Mat image;  ///< CV_8UC3 in R, G, B order, sRGB
  std::vector<WhitePlace> places;
  double white_mm = 0.0;  ///< diameter of the white around each place
};

/// Fits place, light and vignetting of the lamp to the white places of all images.
/// @param texture_u_px, texture_v_px  of the same sensor
/// @returns nullopt if the places do not show a small lamp beside the camera: they are lit from
///          elsewhere, saturated, or too few
[[nodiscard]] std::optional<Flash> fit_flash(const std::vector<FlashImage>& images,
                                             const MeasurementVolume& volume,
                                             const TrivariateCubic& texture_u_px,
                                             const TrivariateCubic& texture_v_px,
                                             const Workers& workers);

/// The same from the middles of the dots in all planes.
[[nodiscard]] std::optional<Flash> fit_flash(const CalibrationSet& set,
                                             const TrivariateCubic& texture_u_px,
                                             const TrivariateCubic& texture_v_px,
                                             const Workers& workers);

}  // namespace flytri::calibration
