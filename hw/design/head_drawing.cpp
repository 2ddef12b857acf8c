#include "hw/design/head_drawing.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace flytri::design {
namespace {

using drawing::Color;
using drawing::Drawing;
using drawing::TextAlign;
using simulated::CameraModel;
using simulated::ProjectorModel;
using simulated::SensorModel;

constexpr Color kCameraColor{0.05, 0.35, 0.65};
constexpr Color kTextureColor{0.15, 0.55, 0.25};
constexpr Color kProjectorColor{0.80, 0.40, 0.05};
constexpr double kDeviceRadius_mm = 2.2;
constexpr double kDepthOnPage_mm = 100.0;  // from the camera to the middle of the volume
const Vec2 kPage_mm(250.0, 175.0);

/// One view: z runs down the page, x or y to the right.
struct HeadView {
  Eigen::Index axis;  ///< 0: x, 1: y
  Vec2 origin_mm;     ///< the middle of the volume, on the page
  double scale;       ///< page mm per mm
  [[nodiscard]] Vec2 at(const Vec3& p_sensor) const {
    return origin_mm + scale * Vec2(p_sensor[axis], p_sensor.z());
  }
};

/// @param from_mm  where the name stands, from the device
void draw_device(Drawing& page, const HeadView& view, const Vec3& center, std::string_view name,
                 const Color& color, const Vec2& from_mm, TextAlign align) {
  page.disk(view.at(center), kDeviceRadius_mm).fill(color);
  page.text(view.at(center) + from_mm, name, {.height_mm = 2.8, .align = align, .color = color});
}

/// The rays to both ends of the middle plane.
void draw_rays(Drawing& page, const HeadView& view, const Vec3& center, const Vec3& half,
               const Color& color) {
  for (const double side : {-1.0, 0.0, 1.0}) {
    Vec3 end = Vec3::Zero();
    end[view.axis] = side * half[view.axis];
    page.line(view.at(center), view.at(end), side == 0.0 ? 0.25 : 0.12, color);
  }
}

/// A measure between two places on the page.
void draw_measure(Drawing& page, const Vec2& from, const Vec2& to, const std::string& text) {
  const Vec2 along = (to - from).normalized();
  const Vec2 across(-along.y(), along.x());
  page.line(from, to, 0.12, drawing::kGray);
  for (const Vec2& end : {from, to})
    page.line(end - 1.2 * across, end + 1.2 * across, 0.12, drawing::kGray);
  const bool is_upright = std::abs(along.y()) > std::abs(along.x());
  page.text(0.5 * (from + to) + (is_upright ? Vec2(-1.2, 0.0) : Vec2(0.0, -1.2)), text,
            {.height_mm = 2.8, .align = TextAlign::kMiddle, .upwards = is_upright});
}

void draw_volume(Drawing& page, const HeadView& view, const SensorModel& sensor) {
  const Vec3 half = 0.5 * sensor.volume.size_mm;
  const Vec2 size = view.scale * Vec2(sensor.volume.size_mm[view.axis], sensor.volume.size_mm.z());
  const Vec2 corner = view.at(-half);
  page.box(corner, size).stroke(0.35);
  const Vec2 below(0.0, size.y() + 5.0);
  draw_measure(page, corner + below, corner + below + Vec2(size.x(), 0.0),
               fmt::format("{:g}", sensor.volume.size_mm[view.axis]));
  const Vec2 left(-4.0, 0.0);
  draw_measure(page, corner + left, corner + left + Vec2(0.0, size.y()),
               fmt::format("{:g}", sensor.volume.size_mm.z()));
}

void draw_focus(Drawing& page, const HeadView& view, const SensorModel& sensor) {
  const double z_mm = sensor.camera.center().z() + sensor.camera.lens.focus_mm;
  const double half_mm = 0.55 * view.scale * sensor.volume.size_mm[view.axis];
  const Vec2 middle = view.at({0.0, 0.0, z_mm});
  page.line(middle - Vec2(half_mm, 0.0), middle + Vec2(half_mm, 0.0), 0.3, kCameraColor);
  page.text(middle + Vec2(half_mm + 1.0, 1.0), "in focus",
            {.height_mm = 2.6, .color = kCameraColor});
}

void draw_view(Drawing& page, const HeadView& view, const SensorModel& sensor,
               const std::string& title) {
  const Pattern pattern = view.axis == 0 ? Pattern::kVertical : Pattern::kHorizontal;
  const ProjectorModel& projector = sensor.projector(pattern);
  const Vec3 camera = sensor.camera.center();
  const Vec3 half = 0.5 * sensor.volume.size_mm;
  page.text(view.origin_mm + Vec2(0.0, -kDepthOnPage_mm - 26.0), title,
            {.height_mm = 3.4, .align = TextAlign::kMiddle});
  draw_rays(page, view, camera, half, kCameraColor);
  draw_rays(page, view, projector.center(), half, kProjectorColor);
  draw_volume(page, view, sensor);
  draw_focus(page, view, sensor);
  draw_device(page, view, sensor.texture_camera.center(), "texture camera", kTextureColor,
              {-3.5, 1.0}, TextAlign::kRight);
  draw_device(page, view, camera, "camera", kCameraColor, {-3.5, 1.0}, TextAlign::kRight);
  draw_device(page, view, projector.center(), fmt::format("{} lines", to_string(pattern)),
              kProjectorColor, {3.5, 1.0}, TextAlign::kLeft);
  const Vec2 above(0.0, -10.0);
  draw_measure(page, view.at(camera) + above, view.at(projector.center()) + above,
               fmt::format("{:.2f}", (projector.center() - camera).norm()));
  const Vec2 right(0.5 * view.scale * sensor.volume.size_mm[view.axis] + 31.0, 0.0);
  draw_measure(page, Vec2(view.origin_mm.x() + right.x(), view.at(camera).y()),
               view.origin_mm + right, fmt::format("{:g}", camera.norm()));
  const double angle_rad = std::acos(camera.normalized().dot(projector.center().normalized()));
  page.text(view.origin_mm + Vec2(7.0, -33.0),
            fmt::format("{:.2f}°", angle_rad * 180.0 / std::numbers::pi), {.height_mm = 2.8});
}

}  // namespace

Drawing head_drawing(const std::string& title, const SensorModel& sensor) {
  Drawing page(kPage_mm);
  page.box(Vec2::Zero(), kPage_mm).fill(drawing::kWhite);
  page.text({8.0, 10.0}, title, {.height_mm = 4.5});
  page.text({8.0, 16.0},
            "Places of the pupils of the lenses. The sensor frame has its origin in the middle of "
            "the volume; z points away from the camera. Measures in mm.",
            {.height_mm = 2.8, .color = drawing::kGray});
  const double scale = kDepthOnPage_mm / sensor.camera.center().norm();
  const double z_mm = 22.0 + 26.0 + kDepthOnPage_mm;
  draw_view(page, {0, {0.27 * kPage_mm.x(), z_mm}, scale}, sensor, "x and z");
  draw_view(page, {1, {0.77 * kPage_mm.x(), z_mm}, scale}, sensor, "y and z");
  return page;
}

}  // namespace flytri::design
