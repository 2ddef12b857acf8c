/// @file  GridLight in one cell: interpolates the light of the pixels from the corners.
#include <algorithm>
#include <cmath>

#include "hw/simulated/optics/grid_light.h"

namespace flytri::simulated {
namespace {

// Light below a tenth of one gray value (8 bits) is ignored.
constexpr float kFaint = 4e-4F;
// Two-point Gauss quadrature over the exposure: the two times, in half exposures from the middle.
const float kGaussPlace = 1.0F / std::sqrt(3.0F);

}  // namespace

// Values that vary slowly between nodes and are interpolated.
struct GridLight::Value {
  float across, blur, distance_mm;
  float brightness;  // of the light that passes
  float begin_shift, end_shift;

  static Value of(const GridNode& node) {
    return {node.across,      node.blur,     node.distance_mm, node.brightness * node.share,
            node.begin_shift, node.end_shift};
  }
  static Value between(const Value& a, const Value& b) {
    return {0.5F * (a.across + b.across),           0.5F * (a.blur + b.blur),
            0.5F * (a.distance_mm + b.distance_mm), 0.5F * (a.brightness + b.brightness),
            0.5F * (a.begin_shift + b.begin_shift), 0.5F * (a.end_shift + b.end_shift)};
  }
};

void GridLight::light_cell(const LineExposure& exposure, const Cell& cell, const Corners& corners,
                           cv::Mat& light) const {
  const Value a = Value::of(*corners[0]);
  const Value b = Value::of(*corners[1]);
  const Value c = Value::of(*corners[2]);
  const Value d = Value::of(*corners[3]);
  const cv::Point at(cell.column * kStep_px, cell.row * kStep_px);
  if (cell.size == 1) return light_block(exposure, at, {a, b, c, d}, light);
  const Value top = Value::between(a, b);
  const Value left = Value::between(a, c);
  const Value right = Value::between(b, d);
  const Value bottom = Value::between(c, d);
  const Value middle = Value::between(left, right);
  light_block(exposure, at, {a, top, left, middle}, light);
  light_block(exposure, at + cv::Point(kStep_px, 0), {top, b, middle, right}, light);
  light_block(exposure, at + cv::Point(0, kStep_px), {left, middle, c, bottom}, light);
  light_block(exposure, at + cv::Point(kStep_px, kStep_px), {middle, right, bottom, d}, light);
}

void GridLight::light_block(const LineExposure& exposure, const cv::Point& at,
                            const std::array<Value, 4>& corners, cv::Mat& light) const {
  const auto& [a, b, c, d] = corners;
  const Value mean = Value::between(Value::between(a, b), Value::between(c, d));
  if (mean.brightness <= kFaint || at.x >= light.cols || at.y >= light.rows) return;
  const auto line = static_cast<float>(mean.across - slide_.from_nearest_line(mean.across));
  const float middle = 0.5F * (mean.begin_shift + mean.end_shift) - line;
  const float side = 0.5F * kGaussPlace * (mean.end_shift - mean.begin_shift);
  const LineProfile::Section section = slide_.profile().section(mean.blur);
  cv::Matx<float, kStep_px, kStep_px> values;
  float brightest = 0.0F;
  // Interpolates along each row of pixels from left to right.
  for (int j = 0; j < kStep_px; ++j) {
    const float down = static_cast<float>(j) / kStep_px;
    const auto mix = [&](float above, float below) { return above + down * (below - above); };
    float offset = mix(a.across, c.across) + middle;
    float brightness = 0.5F * mix(a.brightness, c.brightness);
    const float next_offset = (mix(b.across, d.across) + middle - offset) / kStep_px;
    const float next_brightness = (0.5F * mix(b.brightness, d.brightness) - brightness) / kStep_px;
    for (int i = 0; i < kStep_px; ++i) {
      values(j, i) = brightness * (section(offset - side) + section(offset + side));
      brightest = std::max(brightest, values(j, i));
      offset += next_offset;
      brightness += next_brightness;
    }
  }
  if (brightest > kFaint) exposure.camera_blur.spread(values, at.x, at.y, mean.distance_mm, light);
}

void GridLight::light_pixels(const LineExposure& exposure, const Cell& cell, const Corners& corners,
                             double shift, cv::Mat& light) const {
  const bool all_lit = std::all_of(corners.begin(), corners.end(), [](const GridNode* corner) {
    return !corner->seen || corner->share >= 1.0F;
  });
  constexpr int kPixels = kStep_px * kStep_px;
  std::array<Vec3f, kPixels> directions;
  for (int i = 0; i < kPixels; ++i)
    directions[i] = pixel_direction(cell, i % kStep_px, i / kStep_px);
  RayPacket packet;
  for (int begin = 0; begin < kPixels; begin += RayPacket::kSize) {
    packet.aim(std::span(directions).subspan(begin, RayPacket::kSize));
    exposure.scene.first_hits(exposure.T_model_sensor, camera_.center(), packet);
    const SlidePlaces::Places places = places_.find(packet);
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const cv::Point at(cell.column * kStep_px + (begin + i) % kStep_px,
                         cell.row * kStep_px + (begin + i) / kStep_px);
      if (at.x >= light.cols || at.y >= light.rows) continue;
      GridNode node = make_node(packet, places, i);
      if (node.seen && node.away < shift) light_pixel(exposure, at, all_lit, node, light);
    }
  }
}

// Interpolated between nodes; the error by lens distortion is 0.001 px.
Vec3f GridLight::pixel_direction(const Cell& cell, int i, int j) const {
  const Vec3f* above = &directions_[static_cast<std::size_t>(cell.row) * columns_ + cell.column];
  const Vec3f* below = above + columns_;
  const float right = static_cast<float>(i) / kStep_px;
  const float down = static_cast<float>(j) / kStep_px;
  return (1.0F - down) * ((1.0F - right) * above[0] + right * above[1]) +
         down * ((1.0F - right) * below[0] + right * below[1]);
}

void GridLight::light_pixel(const LineExposure& exposure, const cv::Point& at, bool all_lit,
                            GridNode& node, cv::Mat& light) const {
  shine(exposure, node);
  const auto offset = static_cast<float>(slide_.from_nearest_line(node.across)) +
                      0.5F * (node.begin_shift + node.end_shift);
  const float side = 0.5F * kGaussPlace * (node.end_shift - node.begin_shift);
  const LineProfile::Section section = slide_.profile().section(node.blur);
  const float value = 0.5F * node.brightness * (section(offset - side) + section(offset + side));
  if (value <= kFaint || (!all_lit && slide_.shadowed(exposure, slide_point(node)))) return;
  exposure.camera_blur.spread(value, at.x, at.y, node.distance_mm, light);
}

}  // namespace flytri::simulated
