/// @file  The predicted uncertainty of a design beside the noise of the simulated sensor.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/base/median.h"
#include "core/localization/localize.h"
#include "hw/design/design_change.h"
#include "hw/design/line_image.h"
#include "hw/simulated/datasets/calibration_camera.h"

namespace flytri::design {
namespace {

using simulated::CalibrationCamera;
using simulated::SensorLayout;
using simulated::SensorModel;

struct DesignCase {
  const char* name;
  SensorLayout (*layout)();
  DesignChange change;
};

DesignChange wide_baseline() {
  DesignChange change;
  change.baseline_mm = 15.0;
  change.lines = {{6, 4}};
  return change;
}

DesignChange small_field() {
  DesignChange change;
  change.field_mm = Vec2(120.0, 90.0);
  change.depth_mm = 60.0;
  return change;
}

const std::vector<DesignCase> kCases = {
    {"intraoral", simulated::intraoral_layout, {}},
    {"face", simulated::face_layout, {}},
    {"wide_baseline", simulated::intraoral_layout, wide_baseline()},
    {"small_field", simulated::face_layout, small_field()}};

/// The sensor with half the light, so that no line is overexposed at the near end.
SensorModel sensor_of(const DesignCase& design) {
  SensorModel sensor = make_sensor(changed(design.layout(), design.change).value());
  sensor.chip.line_level *= 0.5;
  sensor.chip.ambient_level *= 0.5;
  return sensor;
}

std::vector<localization::LineTrace> lines_at(const SensorModel& sensor, double z_mm, bool noise) {
  const auto camera = CalibrationCamera::create(
      sensor, {.exposures = 1, .bits = noise ? 8 : 16, .noise = noise, .seed = 5});
  const cv::Mat image = camera->take(calibration::ShotKind::kVertical, z_mm, 3);
  return localization::localize_lines(image, Pattern::kVertical, {}).value();
}

/// Positions by row.
std::multimap<int, localization::LineSample> by_row(
    const std::vector<localization::LineTrace>& traces) {
  std::multimap<int, localization::LineSample> rows;
  for (const auto& trace : traces)
    for (const auto& sample : trace) rows.emplace(sample.along_px, sample);
  return rows;
}

struct Measured {
  double deviation_px = 0.0;  ///< by the median of the absolute errors
  double width_px = 0.0;
  std::size_t count = 0;
};

Measured measure(const SensorModel& sensor, double z_mm) {
  const auto truth = by_row(lines_at(sensor, z_mm, false));
  std::vector<double> errors, widths;
  for (const auto& trace : lines_at(sensor, z_mm, true))
    for (const auto& sample : trace) {
      const auto [first, last] = truth.equal_range(sample.along_px);
      for (auto it = first; it != last; ++it) {
        const double error = std::abs(double(sample.across_px) - it->second.across_px);
        if (error > 2.0) continue;  // another line
        errors.push_back(error);
        widths.push_back(it->second.width_px);
      }
    }
  if (errors.empty()) return {};
  constexpr double kMedianOfNormal = 0.6745;
  return {median_of(errors) / kMedianOfNormal, median_of(widths), errors.size()};
}

class DesignAccuracy : public ::testing::TestWithParam<DesignCase> {};

TEST_P(DesignAccuracy, ThePredictedNoiseIsThatOfTheSimulatedImages) {
  const SensorModel sensor = sensor_of(GetParam());
  const LineImager imager(sensor, Pattern::kVertical);
  const double half_mm = 0.5 * sensor.volume.size_mm.z();
  for (const double z_mm : {-half_mm, 0.0, half_mm}) {
    const LineFigures predicted = imager.figures(z_mm);
    const Measured measured = measure(sensor, z_mm);
    ASSERT_GT(measured.count, 1500U);
    EXPECT_NEAR(measured.deviation_px / predicted.deviation_px, 1.0, 0.12) << "at z " << z_mm;
    EXPECT_NEAR(measured.width_px / predicted.width_px, 1.0, 0.1) << "at z " << z_mm;
    const std::string at = fmt::format("_{}_{:.0f}", GetParam().name, z_mm);
    RecordProperty("predicted_px" + at, fmt::format("{:.4f}", predicted.deviation_px));
    RecordProperty("measured_px" + at, fmt::format("{:.4f}", measured.deviation_px));
    RecordProperty("predicted_um" + at, fmt::format("{:.2f}", 1e3 * predicted.deviation_mm));
    RecordProperty("measured_um" + at,
                   fmt::format("{:.2f}", 1e3 * measured.deviation_px / predicted.motion_px_per_mm));
    RecordProperty("width_px" + at,
                   fmt::format("{:.2f} {:.2f}", predicted.width_px, measured.width_px));
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, DesignAccuracy, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace flytri::design
