/// @file  A camera image with the lines that were found in it.
#pragma once

#include <memory>

#include "core/scan/scan_snapshot.h"
#include "ui/gpu/texture.h"
#include "ui/widgets/draw.h"

namespace flytri::ui {

/// The image of the latest frame in graphics memory; loaded anew only when the frame is another.
struct CameraPicture {
  Texture texture;
  std::shared_ptr<const scan::LiveFrame> frame;

  bool is_new = false;      ///< another image than at the show() before
  bool shows_lines = true;  ///< those that were found, over the image

  void show(const std::shared_ptr<const scan::LiveFrame>& latest);
};

/// A frame's image as a screen shows it: of moderate size, CV_8UC1 or CV_8UC3.
[[nodiscard]] cv::Mat screen_image(const Frame& frame);

/// The image fitted into the box; a plain box with `missing_text` where there is none.
/// @return  where the image lies
Rect camera_image(const Theme& theme, const Rect& box, const CameraPicture& picture,
                  const char* missing_text);

}  // namespace flytri::ui
