#include "ui/window/screenshot.h"

#include <epoxy/gl.h>

#include <opencv2/imgproc.hpp>

#include "core/interchange/png.h"

namespace flytri::ui {

Result<void> save_screenshot(const ImageSize& size, const std::string& path) {
  cv::Mat pixels(size.height_px, size.width_px, CV_8UC3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width_px, size.height_px, GL_RGB, GL_UNSIGNED_BYTE, pixels.data);
  cv::Mat upright;
  cv::flip(pixels, upright, 0);  // OpenGL's first row is at the bottom.
  return write_png(path, upright);
}

}  // namespace flytri::ui
