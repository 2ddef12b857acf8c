#include "ui/widgets/camera_image.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ui/imgui/releases.h"

namespace flytri::ui {
namespace {

/// Length, px on the screen, of the straight pieces that draw a found line.
constexpr float kPiece_px = 8.0F;

/// Position of the middle of a pixel on the screen.
struct PixelPlace {
  Rect image;
  cv::Size size;
  ImVec2 operator()(const Pixel& p) const {
    return {image.x + image.width * static_cast<float>((p.u_px + 0.5) / size.width),
            image.y + image.height * static_cast<float>((p.v_px + 0.5) / size.height)};
  }
};

void draw_line(const std::vector<Pixel>& line, const PixelPlace& place, ImU32 color,
               float thickness) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float points_a_px = static_cast<float>(place.size.width) / place.image.width;
  const auto stride = static_cast<std::size_t>(std::max(kPiece_px * points_a_px, 1.0F));
  for (std::size_t i = 0; i < line.size(); i += stride) list.PathLineTo(place(line[i]));
  if (!line.empty()) list.PathLineTo(place(line.back()));
  list.PathStroke(color, 0, thickness);
}

/// Halved until it is about as wide as shown, to save drawing time.
cv::Mat reduced(cv::Mat image) {
  constexpr int kWidest_px = 640;
  while (image.cols > kWidest_px) {
    cv::Mat half;
    cv::resize(image, half, {}, 0.5, 0.5, cv::INTER_AREA);
    image = half;
  }
  return image;
}

}  // namespace

cv::Mat screen_image(const Frame& frame) {
  cv::Mat image = reduced(frame.image);
  if (image.channels() != 1) return image;
  // Measurement frames are linear in light. Gamma encoding makes the dark surface between the lines
  // visible.
  cv::Mat grey;
  image.convertTo(grey, CV_8U, image.depth() == CV_16U ? 1.0 / 257.0 : 1.0);
  cv::Mat table(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i) {
    table.at<std::uint8_t>(i) =
        cv::saturate_cast<std::uint8_t>(255.0 * std::pow(i / 255.0, 1.0 / 2.2));
  }
  cv::Mat encoded;
  cv::LUT(grey, table, encoded);
  return encoded;
}

void CameraPicture::show(const std::shared_ptr<const scan::LiveFrame>& latest) {
  is_new = latest != frame;
  if (!is_new) return;
  frame = latest;
  if (frame != nullptr && !frame->frame.image.empty()) texture.assign(screen_image(frame->frame));
}

Rect camera_image(const Theme& theme, const Rect& box, const CameraPicture& picture,
                  const char* missing_text) {
  draw_box(box, kBackground, theme.px(kGapXs));
  if (picture.frame == nullptr || picture.frame->frame.image.empty()) {
    draw_text(box, {theme.fonts.body, kTextQuiet, Align::kCenter}, missing_text);
    return box;
  }
  const cv::Size size = picture.frame->frame.image.size();
  const Rect image = fitted(box, static_cast<float>(size.width), static_cast<float>(size.height));
  ImGui::GetWindowDrawList()->AddImageRounded(texture_id(picture.texture.name()), image.min(),
                                              image.max(), {0, 0}, {1, 1}, IM_COL32_WHITE,
                                              theme.px(kGapXs));
  if (!picture.shows_lines) return image;
  for (const std::vector<Pixel>& line : picture.frame->lines) {
    draw_line(line, {image, size}, to_u32(kCaution), theme.px(2.0F));
  }
  return image;
}

}  // namespace flytri::ui
