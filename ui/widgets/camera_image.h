/// @file  A camera image with the lines found in it.
#pragma once

#include <memory>

#include "core/scan/scan_snapshot.h"
#include "ui/gpu/texture.h"
#include "ui/widgets/draw.h"

namespace flytri::ui {

/// The image of the latest frame in graphics memory; loaded only for a new frame.
struct CameraPicture {
  Texture texture;
  std::shared_ptr<const scan::LiveFrame> frame;

  bool is_new = false;      ///< the last show() changed the image
  bool shows_lines = true;  ///< draws the found lines over the image

  void show(const std::shared_ptr<const scan::LiveFrame>& latest);
};

/// The image of a frame for the screen: reduced, CV_8UC1 or CV_8UC3.
[[nodiscard]] cv::Mat screen_image(const Frame& frame);

/// Fits the image into the box; without an image, a plain box with `missing_text`.
/// @return  where the image lies
Rect camera_image(const Theme& theme, const Rect& box, const CameraPicture& picture,
                  const char* missing_text);

}  // namespace flytri::ui
