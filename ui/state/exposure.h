/// @file  Measures how well a live frame is exposed: histogram, marked pixels, advice.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>

#include "core/scan/scan_snapshot.h"
#include "ui/text/texts.h"

namespace flytri::ui {

/// How pixels are marked in the shown image.
enum class ExposureMark : std::uint8_t { kNone, kDark, kSaturated };

/// kNothingSeen: no line was found, so the exposure cannot be judged.
enum class ExposureVerdict { kWell, kTooBright, kTooDark, kNothingSeen };

struct ExposureLimits {
  /// 0..1, share of full scale. Brighter pixels count as clipped; cameras clip a little below 1.
  double clipped = 0.98;
  /// 0..1. Share of the judged pixels that may be clipped. Clipped lines are not fitted.
  double max_saturated = 0.02;
  /// 0..1, share of full scale. Darker pixels have fewer than twenty levels in an 8-bit camera.
  double dark = 0.08;
  /// 0..1, share of full scale, gamma-encoded. Lowest good level of a texture image: an eighth of
  /// the light.
  double min_texture_level = 0.4;
};

/// In measurement frames the found lines are judged; in texture frames all pixels. The level of a
/// texture frame is that of its brightest twentieth, as the background is always dark.
struct Exposure {
  static constexpr std::size_t kBins = 48;
  std::array<double, kBins> histogram = {};  ///< share of all pixels, by brightness, 0..1 each
  double saturated_share = 0.0;              ///< of the judged pixels, 0..1
  double level = 0.0;  ///< share of full scale: median of lines, upper twentieth of textures
  ExposureVerdict verdict = ExposureVerdict::kNothingSeen;
  cv::Mat marks;  ///< CV_8U, ExposureMark by pixel; empty without an image
};

[[nodiscard]] Exposure measure_exposure(const scan::LiveFrame& frame,
                                        const ExposureLimits& limits = {});

/// "Good", or what to change and why, in the user's words.
[[nodiscard]] std::string exposure_advice(const Exposure& exposure, FrameKind kind,
                                          const Texts& texts);

}  // namespace flytri::ui
