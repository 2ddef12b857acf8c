#include "app/lab/label_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flytri::lab {
namespace {

/// Eight colors, so that a line has the color of the eighth one beside it.
constexpr std::array<std::array<std::uint8_t, 3>, 8> kColors = {{{230, 25, 75},
                                                                 {60, 180, 75},
                                                                 {0, 130, 255},
                                                                 {255, 165, 0},
                                                                 {190, 70, 230},
                                                                 {70, 220, 220},
                                                                 {250, 230, 60},
                                                                 {240, 130, 190}}};

}  // namespace

cv::Mat draw_labels(const cv::Mat& image, const indexing::IndexedLines& lines, Pattern pattern) {
  cv::Mat picture(image.size(), CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      // Dim light is shown brighter.
      const double light = image.at<std::uint8_t>(v, u) / 255.0;
      const auto gray = static_cast<std::uint8_t>(160.0 * std::sqrt(light));
      picture.at<cv::Vec3b>(v, u) = {gray, gray, gray};
    }
  }
  for (const indexing::IndexedTrace& trace : lines.traces) {
    const auto& color = kColors[trace.line.at() % kColors.size()];
    for (const localization::LineSample& sample : trace.samples) {
      for (const int beside : {-1, 0, 1}) {
        const Pixel at =
            to_pixel(pattern, {double(sample.along_px), std::round(sample.across_px) + beside});
        const cv::Point place(int(at.u_px), int(at.v_px));
        if (!place.inside(cv::Rect({0, 0}, image.size()))) continue;
        picture.at<cv::Vec3b>(place) = {color[0], color[1], color[2]};
      }
    }
  }
  return picture;
}

}  // namespace flytri::lab
