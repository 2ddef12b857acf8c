#include "core/triangulation/triangulate.h"

#include <cmath>

namespace flytri {
namespace {

/// d(position) / d(across): Z is a function of across alone, X and Y of u, v and z.
Vec3 derivative(const Calibration& calibration, Pattern pattern, const LineRow& row,
                const LineSample& sample, double z_mm) {
  const double slope = row.depth_mm.derivative(sample.across_px);
  const Pixel at = to_pixel(pattern, {double(sample.along_px), sample.across_px});
  const Vec3 uvz(at.u_px, at.v_px, z_mm);
  const int axis = pattern == Pattern::kVertical ? 0 : 1;
  const Vec3 dx = calibration.x_mm.gradient(uvz), dy = calibration.y_mm.gradient(uvz);
  return {dx[axis] + dx[2] * slope, dy[axis] + dy[2] * slope, slope};
}

ProfilePoint make_point(const Calibration& calibration, Pattern pattern, LineIndex line,
                        const LineSample& sample) {
  const LineRow& row =
      calibration.of(pattern).lines[line.at()][static_cast<std::size_t>(sample.along_px)];
  const Vec3 position =
      calibration.locate(pattern, line, {double(sample.along_px), sample.across_px});
  const Vec3 per_px = derivative(calibration, pattern, row, sample, position.z());
  return {position, (sample.sigma_px * per_px).cast<float>(), static_cast<float>(sample.along_px)};
}

bool connected(const LineSample& a, const LineSample& b, const TriangulateOptions& options) {
  const int rows = b.along_px - a.along_px;
  if (rows > options.max_gap_px + 1) return false;
  const double noise = 4.0 * std::hypot(a.sigma_px, b.sigma_px);
  return std::abs(b.across_px - a.across_px) < options.max_jump_px * rows + noise;
}

}  // namespace

Result<void> TriangulateOptions::validate() const {
  if (max_gap_px < 1) {
    return fail(ErrorCode::kBadOption, "max_gap_px is {}, must be >= 1", max_gap_px);
  }
  if (!(max_jump_px > 0)) {
    return fail(ErrorCode::kBadOption, "max_jump_px is {}, must be > 0", max_jump_px);
  }
  if (min_profile_length < 2) {
    return fail(ErrorCode::kBadOption, "min_profile_length is {}, must be >= 2",
                min_profile_length);
  }
  return {};
}

Triangulation triangulate(const IndexedLines& lines, const Calibration& calibration,
                          Pattern pattern, const TriangulateOptions& options) {
  Triangulation result;
  result.view.pattern = pattern;
  const auto& normals = calibration.of(pattern).sheet_normals;
  for (const IndexedTrace& trace : lines.traces) {
    Profile profile{trace.line, normals[trace.line.at()], {}};
    const auto close = [&] {
      if (static_cast<int>(profile.points.size()) >= options.min_profile_length) {
        result.view.profiles.push_back(profile);
      } else {
        result.short_profiles += static_cast<int>(profile.points.size());
      }
      profile.points.clear();
    };
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
      if (i > 0 && !connected(trace.samples[i - 1], trace.samples[i], options)) close();
      profile.points.push_back(make_point(calibration, pattern, trace.line, trace.samples[i]));
    }
    close();
  }
  return result;
}

}  // namespace flytri
