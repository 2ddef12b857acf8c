#include "core/triangulation/triangulate.h"

#include <cmath>

#include "core/base/check_options.h"

namespace flytri::triangulation {
namespace {

/// The profile points of one trace.
class PointMaker {
 public:
  PointMaker(const calibration::Calibration& calibration, Pattern pattern, LineIndex line)
      : calibration_(calibration), pattern_(pattern), line_(line) {}

  ProfilePoint make(const localization::LineSample& sample) {
    const LinePixel pixel{double(sample.along_px), sample.across_px};
    const calibration::LineRow& row =
        calibration_.of(pattern_).lines[line_.at()][static_cast<std::size_t>(sample.along_px)];
    const Vec3 position = calibration_.locate(pattern_, line_, pixel);
    if (sample.along_px >= next_lateral_px_) {
      const Pixel at = to_pixel(pattern_, pixel);
      update_lateral({at.u_px, at.v_px, position.z()});
      next_lateral_px_ = sample.along_px + kLateralStep;
    }
    // z depends only on `across`; x and y depend on u, v and z.
    const double slope = row.depth_mm.derivative(sample.across_px);
    const Vec3 per_px(by_across_.x() + by_depth_.x() * slope,
                      by_across_.y() + by_depth_.y() * slope, slope);
    return {position, (sample.sigma_px * per_px).cast<float>(),
            static_cast<float>(sample.along_px)};
  }

 private:
  /// Rows between two evaluations of the lateral derivatives, which change by only 0.1 % over this
  /// distance.
  static constexpr int kLateralStep = 16;

  void update_lateral(const Vec3& uvz) {
    const int across = pattern_ == Pattern::kVertical ? 0 : 1;
    const Vec3 dx = calibration_.x_mm.gradient(uvz), dy = calibration_.y_mm.gradient(uvz);
    by_across_ = {dx[across], dy[across]};
    by_depth_ = {dx[2], dy[2]};
  }

  const calibration::Calibration& calibration_;
  Pattern pattern_;
  LineIndex line_;
  int next_lateral_px_ = 0;
  Vec2 by_across_ = Vec2::Zero();  ///< d(x, y) / d(across)
  Vec2 by_depth_ = Vec2::Zero();   ///< d(x, y) / d(z)
};

bool connected(const localization::LineSample& a, const localization::LineSample& b,
               const TriangulateOptions& options) {
  const int rows = b.along_px - a.along_px;
  if (rows > options.max_gap_px + 1) return false;
  const double noise = 4.0 * std::hypot(a.sigma_px, b.sigma_px);
  return std::abs(b.across_px - a.across_px) < options.max_jump_px * rows + noise;
}

}  // namespace

Result<void> TriangulateOptions::validate() const {
  return OptionCheck("TriangulateOptions")
      .at_least("max_gap_px", max_gap_px, 1)
      .positive("max_jump_px", max_jump_px)
      .at_least("min_profile_length", min_profile_length, 2)
      .result();
}

Triangulation triangulate(const indexing::IndexedLines& lines,
                          const calibration::Calibration& calibration, Pattern pattern,
                          const TriangulateOptions& options) {
  Triangulation result;
  result.view.pattern = pattern;
  const auto& normals = calibration.of(pattern).sheet_normals;
  for (const indexing::IndexedTrace& trace : lines.traces) {
    Profile profile{trace.line, normals[trace.line.at()], {}};
    const auto close = [&] {
      if (static_cast<int>(profile.points.size()) >= options.min_profile_length) {
        result.view.profiles.push_back(profile);
      } else {
        result.short_profiles += static_cast<int>(profile.points.size());
      }
      profile.points.clear();
    };
    PointMaker maker(calibration, pattern, trace.line);
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
      if (i > 0 && !connected(trace.samples[i - 1], trace.samples[i], options)) close();
      profile.points.push_back(maker.make(trace.samples[i]));
    }
    close();
  }
  return result;
}

}  // namespace flytri::triangulation
