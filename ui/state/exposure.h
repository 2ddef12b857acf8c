/// @file  From a live frame to how well it is exposed: histogram, marked pixels, what to change.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>

#include "core/scan/scan_snapshot.h"

namespace flytri::ui {

/// What becomes of pixels in the marked image.
enum class ExposureMark : std::uint8_t { kNone, kDark, kSaturated };

/// kNothingSeen: no line was found, so that there is nothing to judge by.
enum class ExposureVerdict { kWell, kTooBright, kTooDark, kNothingSeen };

struct ExposureLimits {
  /// 0..1, of full scale. From here on a pixel is clipped: cameras clip a little below it.
  double clipped = 0.98;
  /// 0..1. Share of what is judged that may be clipped: lines that are take no part in the fit.
  double max_saturated = 0.02;
  /// 0..1, of full scale. What is darker has only twenty steps of an 8-bit camera.
  double dark = 0.08;
  /// 0..1, of full scale, as encoded. Least level of a texture image: an eighth of the light.
  double min_texture_level = 0.4;
};

/// Of measurement frames the lines that were found are judged. Of texture frames all pixels are,
/// but for the level the brightest twentieth alone: what lies behind the teeth is always dark.
struct Exposure {
  static constexpr std::size_t kBins = 48;
  std::array<double, kBins> histogram = {};  ///< share of all pixels, by brightness, 0..1 each
  double saturated_share = 0.0;              ///< of what is judged, 0..1
  double level = 0.0;  ///< share of full scale: median of lines, upper twentieth of textures
  ExposureVerdict verdict = ExposureVerdict::kNothingSeen;
  cv::Mat marks;  ///< CV_8U, an ExposureMark for each pixel; empty without an image
};

[[nodiscard]] Exposure measure_exposure(const scan::LiveFrame& frame,
                                        const ExposureLimits& limits = {});

/// "Good", or what to change and why, in the user's words.
[[nodiscard]] std::string exposure_advice(const Exposure& exposure, FrameKind kind);

}  // namespace flytri::ui
