#include "core/live/expected_light.h"

#include <algorithm>
#include <cmath>

namespace flytri::live {
namespace {

/// A line may miss as many rows without a reason in the scene.
constexpr int kReach_px = 4;

/// Places that the line lights, all over its calibrated rows.
std::vector<Vec3> lit_places(const calibration::Calibration& calibration, Pattern pattern,
                             LineIndex line) {
  constexpr std::size_t kAlongStep = 16;
  std::vector<Vec3> places;
  const auto& rows = calibration.of(pattern).lines[line.at()];
  for (std::size_t along = 0; along < rows.size(); along += kAlongStep) {
    const calibration::LineRow& row = rows[along];
    if (!row.valid()) continue;
    for (const double share : {0.0, 0.5, 1.0}) {
      const double across_px = std::lerp(row.area_min_px, row.area_max_px, share);
      places.push_back(calibration.locate(pattern, line, {static_cast<double>(along), across_px}));
    }
  }
  return places;
}

/// The most rows or columns of a line.
std::size_t length_of(const calibration::PatternCalibration& lines) {
  std::size_t length = 0;
  for (const auto& rows : lines.lines) length = std::max(length, rows.size());
  return length;
}

}  // namespace

ExpectedLight::ExpectedLight(const calibration::Calibration& calibration)
    : calibration_(&calibration), camera_center_mm_(calibration.camera_center_mm()) {
  for (const Pattern pattern : kPatterns) {
    const calibration::PatternCalibration& lines = calibration.of(pattern);
    for (std::size_t n = 0; n < lines.lines.size(); ++n) {
      const std::vector<Vec3> places = lit_places(calibration, pattern, LineIndex(n));
      if (places.empty()) continue;
      Sheet sheet{LineIndex(n), lines.sheet_normals[n]};
      for (const Vec3& place : places) sheet.offset_mm += sheet.normal.dot(place);
      sheet.offset_mm /= static_cast<double>(places.size());
      for (const Vec3& place : places) {
        sheet.sag_mm = std::max(sheet.sag_mm, std::abs(sheet.normal.dot(place) - sheet.offset_mm));
      }
      sheets_[static_cast<std::size_t>(pattern)].push_back(sheet);
    }
  }
}

/// Along the ray of the camera, for each mm of depth.
Vec3 ExpectedLight::ray_per_mm(const Vec3& p_sensor) const {
  if (!camera_center_mm_) return Vec3::UnitZ();
  const Vec3 ray = p_sensor - *camera_center_mm_;
  return ray / ray.z();
}

bool ExpectedLight::faces_camera(const Vec3& p_sensor, const Vec3& normal,
                                 double min_cosine) const {
  return -normal.dot(ray_per_mm(p_sensor).normalized()) >= min_cosine;
}

std::optional<ExpectedLine> ExpectedLight::line_at(Pattern pattern, const Vec3& p_sensor,
                                                   double within_mm) const {
  if (!calibration_->volume.contains(p_sensor)) return std::nullopt;
  // Most places lie between the sheets: the image position is computed for the others alone.
  std::optional<LinePixel> at;
  for (const Sheet& sheet : sheets_[static_cast<std::size_t>(pattern)]) {
    const double distance_mm = sheet.normal.dot(p_sensor) - sheet.offset_mm;
    if (std::abs(distance_mm) > within_mm + sheet.sag_mm) continue;
    if (!at) at = to_line_pixel(pattern, calibration_->project_to_measurement(p_sensor));
    const auto& rows = calibration_->of(pattern).lines[sheet.line.at()];
    const auto along_px = std::lround(at->along_px);
    if (along_px < 0 || along_px >= static_cast<long>(rows.size())) continue;
    const calibration::LineRow& row = rows[static_cast<std::size_t>(along_px)];
    if (!row.valid() || at->across_px < row.area_min_px || at->across_px > row.area_max_px) {
      continue;
    }
    // The ray of the camera crosses the light so much deeper than the place.
    const double deeper_mm = row.depth_mm(at->across_px) - p_sensor.z();
    if (std::abs(deeper_mm * sheet.normal.dot(ray_per_mm(p_sensor))) > within_mm) continue;
    return ExpectedLine{sheet.line, static_cast<int>(along_px)};
  }
  return std::nullopt;
}

SeenLines::SeenLines(const View& view, const calibration::Calibration& calibration)
    : pattern_(view.pattern),
      rows_(length_of(calibration.of(view.pattern))),
      depths_mm_(calibration.of(view.pattern).lines.size() * rows_, kNotSeen) {
  if (depths_mm_.empty()) return;
  const int last = static_cast<int>(rows_) - 1;
  for (const Profile& profile : view.profiles) {
    // A line that the calibration does not have lights no place.
    if (profile.line.at() * rows_ >= depths_mm_.size()) continue;
    float* const line = depths_mm_.data() + profile.line.at() * rows_;
    for (const ProfilePoint& point : profile.points) {
      const auto middle = static_cast<int>(std::lround(point.along_px));
      const int from = std::clamp(middle - kReach_px, 0, last);
      const int to = std::clamp(middle + kReach_px, 0, last);
      std::fill(line + from, line + to + 1, static_cast<float>(point.position_mm.z()));
    }
  }
}

std::optional<float> SeenLines::depth_mm(const ExpectedLine& expected) const {
  const float depth_mm =
      depths_mm_[expected.line.at() * rows_ + static_cast<std::size_t>(expected.along_px)];
  if (depth_mm == kNotSeen) return std::nullopt;
  return depth_mm;
}

}  // namespace flytri::live
