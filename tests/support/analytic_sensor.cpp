#include "tests/support/analytic_sensor.h"

#include <cmath>

#include "tests/support/line_image.h"

namespace flytri::testing {

Pixel AnalyticSensor::project(const Vec3& p_sensor) const {
  const double depth = p_sensor.z() + distance_mm;
  const double c = std::cos(roll_rad), s = std::sin(roll_rad);
  const double x = (c * p_sensor.x() - s * p_sensor.y()) / depth;
  const double y = (s * p_sensor.x() + c * p_sensor.y()) / depth;
  const double factor = focal_px * (1.0 + distortion * (x * x + y * y));
  return {0.5 * size.width_px + factor * x, 0.5 * size.height_px + factor * y};
}

Vec3 AnalyticSensor::back_project(const Pixel& pixel, double z_mm) const {
  Vec3 p(0, 0, z_mm);
  const double scale = (z_mm + distance_mm) / focal_px;
  const double c = std::cos(roll_rad), s = std::sin(roll_rad);
  for (int i = 0; i < 20; ++i) {  // the distortion is small, so each step gives two more digits
    const Pixel at = project(p);
    const double du = scale * (pixel.u_px - at.u_px), dv = scale * (pixel.v_px - at.v_px);
    p.x() += c * du + s * dv;
    p.y() += c * dv - s * du;
  }
  return p;
}

double AnalyticSensor::line_mm(Pattern pattern, int n, double z_mm) const {
  const int count = line_counts[static_cast<std::size_t>(pattern)];
  const double at_zero = (n - 0.5 * (count - 1)) * line_spacing_mm;
  return projector_mm + (at_zero - projector_mm) * (z_mm + distance_mm) / distance_mm +
         turn_rad * (z_mm + distance_mm);
}

double AnalyticSensor::across_px(Pattern pattern, int n, double along_px, double z_mm) const {
  const double line = line_mm(pattern, n, z_mm);
  double across = 0.0, other = 0.0;  // the point of the line seen at `along_px`
  for (int i = 0; i < 20; ++i) {
    const Vec3 p =
        pattern == Pattern::kVertical ? Vec3(line, other, z_mm) : Vec3(other, line, z_mm);
    const LinePixel at = to_line_pixel(pattern, project(p));
    other += (along_px - at.along_px) * (z_mm + distance_mm) / focal_px;
    across = at.across_px;
  }
  return across;
}

cv::Mat draw_lines(const AnalyticSensor& sensor, Pattern pattern, double z_mm, std::uint64_t seed) {
  const bool vertical = pattern == Pattern::kVertical;
  LineImage image;
  image.along_count = vertical ? sensor.size.height_px : sensor.size.width_px;
  image.across_count = vertical ? sensor.size.width_px : sensor.size.height_px;
  image.read_noise = sensor.read_noise;
  image.seed = seed;
  std::vector<TrueLine> lines;
  for (int n = 0; n < sensor.line_counts[static_cast<std::size_t>(pattern)]; ++n) {
    std::vector<double> across;
    for (int along = 0; along < image.along_count; ++along) {
      across.push_back(sensor.across_px(pattern, n, along, z_mm));
    }
    lines.push_back({[across](double along) { return across[static_cast<std::size_t>(along)]; },
                     sensor.line_sigma_px(z_mm), [](double) { return 150.0; }});
  }
  return draw(image, lines, pattern);
}

cv::Mat draw_dots(const AnalyticSensor& sensor, const calibration::DotTarget& dots, double z_mm) {
  cv::Mat image(sensor.size.height_px, sensor.size.width_px, CV_8UC1);
  const double blur_mm = 0.06;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const Vec3 p = sensor.back_project({double(u), double(v)}, z_mm);
      const double i = std::round(p.x() / dots.pitch_mm), j = std::round(p.y() / dots.pitch_mm);
      const bool marker = (i == 0 && j == 0) || (i == 1 && j == 0) || (i == 0 && j == 2);
      const double radius = 0.5 * (marker ? dots.marker_diameter_mm : dots.diameter_mm);
      const double distance =
          std::hypot(p.x() - i * dots.pitch_mm, p.y() - j * dots.pitch_mm) - radius;
      const double light = 0.5 * std::erfc(distance / blur_mm);
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(std::lround(8.0 + 180.0 * light));
    }
  }
  return image;
}

calibration::CalibrationSet draw_set(const AnalyticSensor& sensor, int plane_count) {
  calibration::CalibrationSet set;
  set.volume.size_mm = sensor.volume_mm;
  set.line_counts = sensor.line_counts;
  set.dots = {1.0, 0.5, 0.8};
  for (int i = 0; i < plane_count; ++i) {
    calibration::CalibrationPlane plane;
    plane.z_mm = sensor.volume_mm.z() * (static_cast<double>(i) / (plane_count - 1) - 0.5);
    const auto seed = static_cast<std::uint64_t>(2 * i + 1);
    plane.vertical = draw_lines(sensor, Pattern::kVertical, plane.z_mm, seed);
    plane.horizontal = draw_lines(sensor, Pattern::kHorizontal, plane.z_mm, seed + 1);
    plane.dots = draw_dots(sensor, set.dots, plane.z_mm);
    cv::merge(std::vector<cv::Mat>(3, plane.dots), plane.dots_texture);
    plane.vertical_name = fmt::format("z{}_v.png", i);
    plane.horizontal_name = fmt::format("z{}_h.png", i);
    plane.dots_name = fmt::format("z{}_d.png", i);
    plane.dots_texture_name = fmt::format("z{}_t.png", i);
    set.planes.push_back(plane);
  }
  return set;
}

}  // namespace flytri::testing
