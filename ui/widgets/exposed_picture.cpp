#include "ui/widgets/exposed_picture.h"

#include <opencv2/imgproc.hpp>

namespace flytri::ui {
namespace {

cv::Scalar rgb(const Color& color) {
  return {255.0 * color[0], 255.0 * color[1], 255.0 * color[2]};
}

/// Opacity of marks: thin lines need more than areas.
constexpr double kLineInk = 1.0, kAreaInk = 0.35;

void paint(cv::Mat& image, const cv::Mat& marks, ExposureMark mark, const Color& color,
           double ink) {
  const cv::Mat marked = marks == static_cast<double>(mark);
  cv::Mat mask;
  // Averaging keeps a trace of a single marked pixel.
  cv::resize(marked, mask, image.size(), 0.0, 0.0, cv::INTER_AREA);
  const cv::Mat colored(image.size(), image.type(), rgb(color));
  cv::Mat mixed;
  cv::addWeighted(colored, ink, image, 1.0 - ink, 0.0, mixed);
  mixed.copyTo(image, mask > 0);
}

}  // namespace

cv::Mat marked_image(const Frame& frame, const cv::Mat& marks) {
  const cv::Mat plain = screen_image(frame);
  cv::Mat image = plain;
  if (plain.channels() == 1)
    cv::cvtColor(plain, image, cv::COLOR_GRAY2RGB);
  else
    image = plain.clone();
  const bool is_texture = frame.kind == FrameKind::kTexture;
  paint(image, marks, ExposureMark::kDark, kDarkMark, is_texture ? kAreaInk : kLineInk);
  paint(image, marks, ExposureMark::kSaturated, kClippedMark, kLineInk);
  return image;
}

void ExposedPicture::show(const std::shared_ptr<const scan::LiveFrame>& latest) {
  picture.shows_lines = false;
  picture.is_new = latest != picture.frame;
  if (!picture.is_new) return;
  picture.frame = latest;
  exposure = latest == nullptr ? Exposure{} : measure_exposure(*latest);
  if (!exposure.marks.empty()) {
    picture.texture.assign(marked_image(latest->frame, exposure.marks));
  }
}

}  // namespace flytri::ui
