#include "core/calibration/fit/fit_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/check_options.h"
#include "core/calibration/fit/least_squares.h"
#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

constexpr int kDepthTerms = 4;
constexpr int kWidthTerms = 3;
/// A row is calibrated if the line was seen near it on this many planes: the number of terms of Z.
constexpr int kMinPlanesOfRow = kDepthTerms;
/// Rows at this distance count as near: ends of traces are trimmed by about a line width.
constexpr int kNearRows = 24;

struct SurfaceData {
  std::vector<SurfaceDatum> depth, width;
};

SurfaceData data_of(const std::vector<LineOnPlane>& line) {
  SurfaceData data;
  for (const LineOnPlane& plane : line) {
    for (std::size_t i = 0; i < plane.samples.size(); ++i) {
      const localization::LineSample& sample = plane.samples[i];
      if (sample.saturated) continue;
      data.depth.push_back({sample.across_px, double(sample.along_px), plane.z_mm[i]});
      data.width.push_back({sample.across_px, double(sample.along_px), sample.width_px});
    }
  }
  return data;
}

/// For each row, the number of planes on which the line was seen nearby.
std::vector<int> planes_seen(const std::vector<LineOnPlane>& line, int along_count) {
  std::vector<int> count(static_cast<std::size_t>(along_count), 0);
  for (const LineOnPlane& plane : line) {
    std::vector<bool> near(count.size(), false);
    for (const localization::LineSample& sample : plane.samples) {
      const int first = std::max(sample.along_px - kNearRows, 0);
      const int last = std::min(sample.along_px + kNearRows, along_count - 1);
      std::fill(near.begin() + first, near.begin() + last + 1, true);
    }
    for (std::size_t i = 0; i < count.size(); ++i) count[i] += near[i] ? 1 : 0;
  }
  return count;
}

template <int kTerms>
Polynomial<kTerms> row_polynomial(const LineSurface& surface, int along) {
  Polynomial<kTerms> polynomial{surface.across_center, surface.across_half_range, {}};
  const Eigen::VectorXd coefficients = surface.row(along);
  for (int i = 0; i < kTerms; ++i) polynomial.coefficients[std::size_t(i)] = coefficients[i];
  return polynomial;
}

/// Position between `low` and `high` at which Z is `z_mm`; the nearer end if Z does not reach it. Z
/// must be monotonic there.
double across_at(const Polynomial<kDepthTerms>& depth_mm, double z_mm, double low, double high) {
  const bool rising = depth_mm(high) > depth_mm(low);
  const auto below = [&](double across) { return (depth_mm(across) < z_mm) == rising; };
  if (!below(low)) return low;
  if (below(high)) return high;
  for (int i = 0; i < 40; ++i) {  // forty bisections of 1000 px give 1e-9 px
    const double middle = 0.5 * (low + high);
    (below(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// True if Z is monotonic in [low, high].
bool monotonic(const Polynomial<kDepthTerms>& depth_mm, double low, double high) {
  constexpr int kChecks = 16;
  const bool rising = depth_mm.derivative(low) > 0;
  for (int i = 0; i <= kChecks; ++i) {
    const double slope = depth_mm.derivative(low + (high - low) * i / kChecks);
    if (slope == 0.0 || (slope > 0) != rising) return false;
  }
  return true;
}

/// Sets the unique area of a row: the positions of the line inside the depth of the volume.
void cut_area(LineRow& row, double half_depth_mm, double low, double high) {
  const double a = across_at(row.depth_mm, -half_depth_mm, low, high);
  const double b = across_at(row.depth_mm, half_depth_mm, low, high);
  row.area_min_px = std::min(a, b);
  row.area_max_px = std::max(a, b);
}

Result<std::vector<LineRow>> fit_line(const std::vector<LineOnPlane>& line,
                                      const MeasurementVolume& volume, int along_count,
                                      int across_count, const LineFitOptions& options,
                                      PatternCalibration& residuals) {
  const SurfaceData data = data_of(line);
  const auto depth = fit_surface(data.depth, kDepthTerms - 1, options.depth_along_degree);
  if (!depth) return tl::unexpected(depth.error());
  const auto width = fit_surface(data.width, kWidthTerms - 1, options.width_along_degree);
  if (!width) return tl::unexpected(width.error());

  // The planes may cover a little less than the volume: extrapolate the polynomial by a tenth of
  // its range.
  const double reach = 1.1 * depth->across_half_range;
  const double low = std::max(depth->across_center - reach, 0.0);
  const double high = std::min(depth->across_center + reach, across_count - 1.0);
  const std::vector<int> seen = planes_seen(line, along_count);
  std::vector<LineRow> rows(static_cast<std::size_t>(along_count));
  for (int along = 0; along < along_count; ++along) {
    LineRow& row = rows[static_cast<std::size_t>(along)];
    if (seen[static_cast<std::size_t>(along)] < kMinPlanesOfRow) continue;
    row.depth_mm = row_polynomial<kDepthTerms>(*depth, along);
    row.width_px = row_polynomial<kWidthTerms>(*width, along);
    if (!monotonic(row.depth_mm, low, high)) {
      return fail(ErrorCode::kInconsistent,
                  "the depth is not a unique function of the position in row {}; check the images "
                  "of this line",
                  along);
    }
    cut_area(row, 0.5 * volume.size_mm.z(), low, high);
  }
  const auto add = [](FitResidual& sum, const FitResidual& part) {
    const double squares = sum.rms * sum.rms * static_cast<double>(sum.count) +
                           part.rms * part.rms * static_cast<double>(part.count);
    sum.count += part.count;
    sum.rms = std::sqrt(squares / static_cast<double>(sum.count));
    sum.max = std::max(sum.max, part.max);
  };
  add(residuals.depth_residual_mm, depth->residual);
  add(residuals.width_residual_px, width->residual);
  return rows;
}

/// The areas of two neighboring lines in one row; none if one of them is not calibrated there.
struct Neighbors {
  LineRow& left;
  LineRow& right;
  [[nodiscard]] double shared_px() const { return left.area_max_px - right.area_min_px; }
};

template <typename ActT>
void for_each_neighbors(PatternCalibration& pattern, const ActT& act) {
  for (std::size_t along = 0; along < pattern.lines.front().size(); ++along) {
    for (std::size_t n = 0; n + 1 < pattern.lines.size(); ++n) {
      const Neighbors two{pattern.lines[n][along], pattern.lines[n + 1][along]};
      if (two.left.valid() && two.right.valid()) act(two);
    }
  }
}

/// Makes the areas of neighboring lines disjoint: positions in both areas are removed from both.
/// Areas that share more are those of dense lines, and stay as they are.
void separate_areas(PatternCalibration& pattern) {
  constexpr double kMaxShared = 0.1;
  bool is_dense = false;
  for_each_neighbors(pattern, [&](const Neighbors& two) {
    const double width_px = two.left.area_max_px - two.left.area_min_px;
    is_dense = is_dense || two.shared_px() > kMaxShared * width_px;
  });
  if (is_dense) return;
  for_each_neighbors(pattern, [](const Neighbors& two) {
    if (two.shared_px() < 0.0) return;
    const double left_end = two.right.area_min_px;
    two.right.area_min_px = std::nextafter(two.left.area_max_px, two.right.area_max_px);
    two.left.area_max_px = std::nextafter(left_end, two.left.area_min_px);
  });
}

}  // namespace

Result<void> LineFitOptions::validate() const {
  return OptionCheck("LineFitOptions")
      .in_range("depth_along_degree", depth_along_degree, 0, 8)
      .in_range("width_along_degree", width_along_degree, 0, 8)
      .result();
}

Result<PatternCalibration> fit_lines(const NumberedLines& lines, Pattern pattern,
                                     const MeasurementVolume& volume, ImageSize image_size,
                                     const LineFitOptions& options) {
  const bool vertical = pattern == Pattern::kVertical;
  const int along_count = vertical ? image_size.height_px : image_size.width_px;
  const int across_count = vertical ? image_size.width_px : image_size.height_px;
  PatternCalibration result;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    auto rows = fit_line(lines[n], volume, along_count, across_count, options, result);
    if (!rows) {
      return fail(rows.error().code, "{} line {}: {}", to_string(pattern), n, rows.error().message);
    }
    result.lines.push_back(std::move(*rows));
  }
  separate_areas(result);
  return result;
}

std::vector<Vec3> sheet_normals(const Calibration& calibration, Pattern pattern) {
  constexpr int kAlongStep = 16;  // few points are enough for a plane
  constexpr int kAcrossSteps = 8;
  std::vector<Vec3> normals;
  const auto& lines = calibration.of(pattern).lines;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    std::vector<Vec3> points;
    for (std::size_t along = 0; along < lines[n].size(); along += kAlongStep) {
      const LineRow& row = lines[n][along];
      if (!row.valid()) continue;
      for (int i = 0; i <= kAcrossSteps; ++i) {
        const double across =
            row.area_min_px + (row.area_max_px - row.area_min_px) * i / kAcrossSteps;
        points.push_back(
            calibration.locate(pattern, LineIndex(n), {static_cast<double>(along), across}));
      }
    }
    Vec3 mean = Vec3::Zero();
    for (const Vec3& point : points) mean += point / static_cast<double>(points.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Vec3& point : points) scatter += (point - mean) * (point - mean).transpose();
    const Vec3 normal = symmetric_eigen(scatter).vectors.col(0);
    const int main_axis = pattern == Pattern::kVertical ? 0 : 1;
    normals.push_back(normal[main_axis] < 0 ? Vec3(-normal) : normal);
  }
  return normals;
}

}  // namespace flytri::calibration
