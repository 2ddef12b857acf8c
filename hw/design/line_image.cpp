#include "hw/design/line_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hw/design/localization_noise.h"
#include "hw/simulated/optics/line_position.h"

namespace flytri::design {
namespace {

using simulated::LensBlur;
using simulated::LineProfile;
using simulated::ProjectorModel;
using simulated::SensorModel;

double largest_projector_blur(const SensorModel& sensor, const ProjectorModel& projector) {
  const double distance_mm = projector.center().norm();
  double largest = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const double at_mm = distance_mm + side * imager_reach_mm(sensor);
    largest = std::max(largest, projector.lens.blur_radius_mm(at_mm) / at_mm);
  }
  return largest;
}

// What a camera makes of a point, in one dimension.
std::vector<double> line_spread(const cv::Mat& kernel) {
  std::vector<double> sums(static_cast<std::size_t>(kernel.cols), 0.0);
  for (int v = 0; v < kernel.rows; ++v)
    for (int u = 0; u < kernel.cols; ++u)
      sums[static_cast<std::size_t>(u)] += kernel.at<float>(v, u);
  return sums;
}

// Full width at half maximum of a symmetric function that falls from 0 to `reach`.
template <typename Function>
double full_width(const Function& function, double reach) {
  const double half = 0.5 * function(0.0);
  double low = 0.0;
  double high = reach;
  for (int step = 0; step < 30; ++step) {
    const double middle = 0.5 * (low + high);
    (function(middle) > half ? low : high) = middle;
  }
  return low + high;
}

// Full width at half maximum of a sampled function, by linear interpolation from its middle.
double full_width(const std::vector<double>& samples) {
  const std::size_t middle = samples.size() / 2;
  const double half = 0.5 * samples[middle];
  for (std::size_t i = middle; i + 1 < samples.size(); ++i) {
    if (samples[i + 1] < half) {
      return 2.0 * (static_cast<double>(i - middle) +
                    (samples[i] - half) / (samples[i] - samples[i + 1]));
    }
  }
  return static_cast<double>(samples.size());
}

}  // namespace

double imager_reach_mm(const SensorModel& sensor) {
  return std::min(2.0 * sensor.volume.size_mm.z(), 0.8 * sensor.camera.center().norm());
}

// The light across the line at one depth.
class LineImager::Section {
 public:
  Section(const LineProfile& profile, double blur, double across_per_px, double gain,
          std::vector<double> spread)
      : profile_(profile),
        blur_(blur),
        across_per_px_(across_per_px),
        gain_(gain),
        spread_(std::move(spread)) {}

  // On the object, before the camera's lens. Share of full scale.
  [[nodiscard]] double sharp(double offset_px) const {
    return gain_ * profile_(offset_px * across_per_px_, blur_);
  }
  [[nodiscard]] double operator()(double offset_px) const {
    const double half = half_px();
    double sum = 0.0;
    for (std::size_t k = 0; k < spread_.size(); ++k)
      sum += spread_[k] * sharp(offset_px - (static_cast<double>(k) - half));
    return sum;
  }
  [[nodiscard]] double reach_px() const {
    return profile_.reach(blur_) / across_per_px_ + half_px() + 1.0;
  }
  [[nodiscard]] const std::vector<double>& spread() const { return spread_; }

 private:
  // From the middle of the spread to its end.
  [[nodiscard]] double half_px() const {
    const std::size_t half = spread_.size() / 2;
    return static_cast<double>(half);
  }

  const LineProfile& profile_;
  double blur_, across_per_px_, gain_;
  std::vector<double> spread_;
};

LineImager::LineImager(const SensorModel& sensor, Pattern pattern)
    : sensor_(sensor),
      pattern_(pattern),
      nearest_mm_(sensor.camera.center().norm() - imager_reach_mm(sensor)),
      farthest_mm_(sensor.camera.center().norm() + imager_reach_mm(sensor)),
      profile_(sensor.projector(pattern),
               largest_projector_blur(sensor, sensor.projector(pattern))),
      blur_(sensor.camera, nearest_mm_, farthest_mm_) {
  gain_ = sensor.chip.line_level / section(0.0)(0.0);
}

LineImager::Section LineImager::section(double z_mm) const {
  const ProjectorModel& projector = sensor_.projector(pattern_);
  const Vec3 place(0.0, 0.0, z_mm);
  const double camera_mm = (place - sensor_.camera.center()).norm();
  const double projector_mm = (place - projector.center()).norm();
  const double blur = projector.lens.blur_radius_mm(projector_mm) / projector_mm;
  // How the place on the slide changes from pixel to pixel on this plane.
  constexpr double kStep = 1e-4;
  const double row_px = to_line_pixel(pattern_, sensor_.camera.project(place).value()).along_px;
  const double across = projector.slide_place(place).value().x();
  const double moved_px = across_in_row(sensor_, projector, across + kStep, row_px, z_mm) -
                          across_in_row(sensor_, projector, across - kStep, row_px, z_mm);
  const double falloff = std::pow(projector.center().norm() / projector_mm, 2);
  return {profile_, blur, 2.0 * kStep / std::abs(moved_px), gain_ * falloff,
          line_spread(blur_.kernel(camera_mm))};
}

double LineImager::width_px(double z_mm) const {
  const Section light = section(z_mm);
  return full_width(light, light.reach_px());
}

LineFigures LineImager::figures(double z_mm) const {
  const Section light = section(z_mm);
  const ProjectorModel& projector = sensor_.projector(pattern_);
  const double row_px =
      to_line_pixel(pattern_, sensor_.camera.project({0.0, 0.0, z_mm}).value()).along_px;
  LineFigures figures;
  figures.z_mm = z_mm;
  figures.pixel_mm = (z_mm - sensor_.camera.center().z()) / sensor_.camera.focal_px;
  const auto sharp = [&](double offset_px) { return light.sharp(offset_px); };
  figures.width_mm = full_width(sharp, light.reach_px()) * figures.pixel_mm;
  const FittedLine line = fit_line_light(light, width_px(z_mm), sensor_.chip);
  figures.width_px = kWidthPerSigma * line.sigma_px;
  figures.camera_blur_px = full_width(light.spread());
  constexpr double kStep_mm = 1e-3;
  const double across = projector.slide_place({0.0, 0.0, z_mm}).value().x();
  figures.motion_px_per_mm =
      std::abs(across_in_row(sensor_, projector, across, row_px, z_mm + kStep_mm) -
               across_in_row(sensor_, projector, across, row_px, z_mm - kStep_mm)) /
      (2.0 * kStep_mm);
  const auto half_px = static_cast<int>(std::ceil(light.reach_px()));
  figures.deviation_px = localization_deviation_px(light, line, half_px, sensor_.chip);
  figures.deviation_mm = figures.deviation_px / figures.motion_px_per_mm;
  return figures;
}

}  // namespace flytri::design
