#include "tests/ui/screen_reader.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace flytri::testing {

cv::Mat read_screen(int width_px, int height_px) {
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return {};
  cv::Mat picture;
  XImage* image =
      XGetImage(display, DefaultRootWindow(display), 0, 0, static_cast<unsigned>(width_px),
                static_cast<unsigned>(height_px), AllPlanes, ZPixmap);
  if (image != nullptr && image->red_mask == 0xff0000 && image->blue_mask == 0xff) {
    picture.create(height_px, width_px, CV_8UC3);
    for (int row = 0; row < height_px; ++row) {
      for (int col = 0; col < width_px; ++col) {
        const unsigned long value = XGetPixel(image, col, row);
        picture.at<cv::Vec3b>(row, col) =
            cv::Vec3b(static_cast<std::uint8_t>(value >> 16U),
                      static_cast<std::uint8_t>(value >> 8U), static_cast<std::uint8_t>(value));
      }
    }
  }
  if (image != nullptr) XDestroyImage(image);
  XCloseDisplay(display);
  return picture;
}

}  // namespace flytri::testing
