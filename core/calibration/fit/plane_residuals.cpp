#include "core/calibration/fit/plane_residuals.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"

namespace flytri::calibration {
namespace {

struct DepthSum {
  double first = 0.0, second = 0.0;
  std::int64_t count = 0;
};

/// Sums of the measured depth minus the true one over all samples of a line on a plane.
DepthSum sum_of(const LineOnPlane& plane, const std::vector<LineRow>& rows) {
  DepthSum sum;
  for (std::size_t i = 0; i < plane.samples.size(); ++i) {
    const localization::LineSample& sample = plane.samples[i];
    const LineRow& row = rows[static_cast<std::size_t>(sample.along_px)];
    if (!row.valid() || sample.saturated) continue;
    const double off_mm = row.depth_mm(sample.across_px) - plane.z_mm[i];
    sum.first += off_mm;
    sum.second += off_mm * off_mm;
    sum.count += 1;
  }
  return sum;
}

/// The larger absolute offset of the two patterns.
double worst_mm(const PlaneResidual& plane) {
  return std::max(std::abs(plane.offset_mm[0]), std::abs(plane.offset_mm[1]));
}

}  // namespace

Result<void> PlaneResidualOptions::validate() const {
  return OptionCheck("PlaneResidualOptions")
      .positive("max_offset_share", max_offset_share)
      .result();
}

void add_residuals(const NumberedLines& lines, const PatternCalibration& calibration,
                   Pattern pattern, std::vector<PlaneResidual>& planes) {
  const auto p = static_cast<std::size_t>(pattern);
  std::vector<DepthSum> sums(planes.size());
  for (std::size_t n = 0; n < lines.size(); ++n) {
    for (const LineOnPlane& plane : lines[n]) {
      const DepthSum part = sum_of(plane, calibration.lines[n]);
      DepthSum& sum = sums[plane.plane];
      sum.first += part.first;
      sum.second += part.second;
      sum.count += part.count;
    }
  }
  for (std::size_t i = 0; i < planes.size(); ++i) {
    planes[i].count[p] = sums[i].count;
    if (sums[i].count == 0) continue;
    const double n = static_cast<double>(sums[i].count);
    planes[i].offset_mm[p] = sums[i].first / n;
    planes[i].rms_mm[p] =
        std::sqrt(std::max(sums[i].second / n - std::pow(planes[i].offset_mm[p], 2), 0.0));
  }
}

Result<std::vector<PlaneResidual>> plane_residuals(const CalibrationSet& set,
                                                   const Calibration& calibration,
                                                   const localization::LocalizeOptions& options,
                                                   const Workers& workers) {
  std::vector<PlaneResidual> planes(set.planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) planes[i].z_mm = set.planes[i].z_mm;
  for (const Pattern pattern : kPatterns) {
    const auto numbered = number_lines(
        set, pattern,
        calibration.of(pattern).has_shared_areas() ? for_dense_lines(options) : options, workers);
    if (!numbered) return tl::unexpected(numbered.error());
    add_residuals(*numbered, calibration.of(pattern), pattern, planes);
  }
  return planes;
}

Result<void> check_plane_residuals(const std::vector<PlaneResidual>& planes,
                                   const MeasurementVolume& volume,
                                   const PlaneResidualOptions& options) {
  const double limit_mm = options.max_offset_share * volume.size_mm.z();
  const auto worst =
      std::max_element(planes.begin(), planes.end(),
                       [](const auto& a, const auto& b) { return worst_mm(a) < worst_mm(b); });
  if (worst == planes.end() || worst_mm(*worst) <= limit_mm) return {};
  constexpr double kMicrons = 1e3;
  const bool moved = std::abs(worst->offset_mm[0] - worst->offset_mm[1]) > limit_mm;
  return fail(ErrorCode::kInconsistent,
              "the plane at z = {:.2f} mm does not fit the others: its vertical lines are {:+.0f} "
              "µm and its horizontal lines {:+.0f} µm away from this depth, more than {:.0f} µm; "
              "{}; take its images again",
              worst->z_mm, kMicrons * worst->offset_mm[0], kMicrons * worst->offset_mm[1],
              kMicrons * limit_mm,
              moved ? "it moved between its shots" : "it was not at that depth");
}

}  // namespace flytri::calibration
