/// @file  A camera image on which pixels that are clipped or too dark are marked.
#pragma once

#include <memory>

#include "ui/state/exposure.h"
#include "ui/theme/status_colors.h"
#include "ui/widgets/camera_image.h"

namespace flytri::ui {

inline constexpr Color kClippedMark = kBad;
inline constexpr Color kDarkMark = kNeutral;

/// Measured and loaded only for a new frame.
struct ExposedPicture {
  CameraPicture picture;
  Exposure exposure;

  void show(const std::shared_ptr<const scan::LiveFrame>& latest);
};

/// The image for the screen, RGB, with its marks in the colors above. Marks stay visible however
/// much the image is reduced.
[[nodiscard]] cv::Mat marked_image(const Frame& frame, const cv::Mat& marks);

}  // namespace flytri::ui
