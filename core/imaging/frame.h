/// @file  One image of a sensor: which light was on, and when it was taken.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "core/base/index.h"
#include "core/imaging/pattern.h"

namespace flytri {

/// Width and height of an image in pixels.
struct ImageSize {
  int width_px = 0;
  int height_px = 0;
  bool operator==(const ImageSize&) const = default;
};

/// What a frame shows. kUnknown: a measurement frame; its pattern is recognized from the image.
enum class FrameKind { kVertical, kHorizontal, kTexture, kUnknown };

[[nodiscard]] constexpr std::optional<Pattern> pattern_of(FrameKind kind) {
  if (kind == FrameKind::kVertical) return Pattern::kVertical;
  if (kind == FrameKind::kHorizontal) return Pattern::kHorizontal;
  return std::nullopt;
}

/// One exposure. Measurement frames are CV_8UC1 or CV_16UC1, linear in light; texture frames are
/// CV_8UC3 in R, G, B order, sRGB. Copies of a frame share the image, which is never modified.
struct Frame {
  FrameIndex index;  ///< position in the recording
  FrameKind kind = FrameKind::kUnknown;
  double time_s = 0.0;  ///< middle of the exposure
  cv::Mat image;
};

}  // namespace flytri
