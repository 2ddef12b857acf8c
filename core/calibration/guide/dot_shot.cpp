#include "core/calibration/guide/dot_shot.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/median.h"
#include "core/calibration/fit/find_dots.h"
#include "core/calibration/fit/number_dots.h"
#include "core/geometry/decompositions.h"
#include "core/geometry/rigid.h"

namespace flytri::calibration {
namespace {

constexpr double kLinearScale8 = 255.0;  // of linear_gray, for 8-bit images

double linear_scale(const cv::Mat& image) {
  return image.channels() == 1 ? full_scale(image) : kLinearScale8;
}

/// Share of dots whose center is clipped in any channel.
double clipped_share(const cv::Mat& image, const std::vector<Dot>& dots) {
  constexpr double kClipped = 0.995;
  const cv::Mat values = image.reshape(1);
  int clipped = 0;
  for (const Dot& dot : dots) {
    const auto v = static_cast<int>(std::lround(dot.center.v_px));
    const auto u = static_cast<int>(std::lround(dot.center.u_px)) * image.channels();
    double brightest = 0.0;
    for (int channel = 0; channel < image.channels(); ++channel) {
      const double value = image.depth() == CV_16U ? values.at<std::uint16_t>(v, u + channel)
                                                   : values.at<std::uint8_t>(v, u + channel);
      brightest = std::max(brightest, value);
    }
    if (brightest >= kClipped * full_scale(image)) ++clipped;
  }
  return static_cast<double>(clipped) / static_cast<double>(dots.size());
}

/// Width of a dot's edge: its height divided by its steepest slope, px; median of all dots.
double edge_width_px(const cv::Mat& gray, const std::vector<Dot>& dots) {
  cv::Mat along_u, along_v, slope;
  constexpr double kScharr = 1.0 / 32.0;  // to gray values per pixel
  cv::Scharr(gray, along_u, CV_32F, 1, 0, kScharr);
  cv::Scharr(gray, along_v, CV_32F, 0, 1, kScharr);
  cv::magnitude(along_u, along_v, slope);
  std::vector<double> widths;
  for (const Dot& dot : dots) {
    const auto reach = static_cast<int>(std::sqrt(dot.area_px / CV_PI)) + 2;
    const cv::Point middle(static_cast<int>(dot.center.u_px), static_cast<int>(dot.center.v_px));
    const cv::Rect box =
        cv::Rect(middle.x - reach, middle.y - reach, 2 * reach + 1, 2 * reach + 1) &
        cv::Rect(0, 0, gray.cols, gray.rows);
    double steepest = 0.0;
    cv::minMaxLoc(slope(box), nullptr, &steepest);
    if (steepest > 0.0) widths.push_back(dot.brightness / steepest);
  }
  return widths.empty() ? 0.0 : median_of(widths);
}

ShotFigures measure_dots(const cv::Mat& image, const cv::Mat& gray, const std::vector<Dot>& dots) {
  ShotFigures figures;
  figures.found = static_cast<int>(dots.size());
  if (dots.empty()) return figures;
  std::vector<double> heights;
  heights.reserve(dots.size());
  for (const Dot& dot : dots) heights.push_back(dot.brightness / linear_scale(image));
  figures.brightness = median_of(heights);
  figures.saturated = clipped_share(image, dots);
  figures.width_px = edge_width_px(gray, dots);
  return figures;
}

double median_diameter_px(const std::vector<Dot>& dots) {
  std::vector<double> areas;
  areas.reserve(dots.size());
  for (const Dot& dot : dots) areas.push_back(dot.area_px);
  return 2.0 * std::sqrt(median_of(areas) / CV_PI);
}

bool is_mirrored(std::vector<Dot> dots, const DotTarget& target) {
  for (Dot& dot : dots) dot.center.u_px = -dot.center.u_px;
  return number_dots(dots, target).has_value();
}

/// Image positions as a quadratic function of (i, j): approximates the perspective.
class TargetMap {
 public:
  static constexpr int kTerms = 6;
  explicit TargetMap(const std::vector<NumberedDot>& dots) {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(dots.size()), kTerms);
    Eigen::MatrixX2d values(rows.rows(), 2);
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
      const NumberedDot& dot = dots[static_cast<std::size_t>(k)];
      rows.row(k) = terms(dot.i, dot.j);
      values.row(k) << dot.center.u_px, dot.center.v_px;
    }
    coefficients_ = solve_each_least_squares(rows, values);
  }
  [[nodiscard]] Pixel operator()(int i, int j) const {
    const Eigen::RowVector2d at = terms(i, j) * coefficients_;
    return {at.x(), at.y()};
  }
  [[nodiscard]] double pitch_px() const {
    const Eigen::Matrix2d jacobian = coefficients_.middleRows<2>(1);
    return std::sqrt(std::abs(jacobian.determinant()));
  }

 private:
  static Eigen::RowVectorXd terms(double i, double j) {
    Eigen::RowVectorXd row(kTerms);
    row << 1.0, i, j, i * i, i * j, j * j;
    return row;
  }
  Eigen::MatrixX2d coefficients_;
};

/// Range of the dot numbers inside the volume.
struct DotReach {
  int i = 0, j = 0;
  DotReach(const DotTarget& target, const MeasurementVolume& volume)
      : i(static_cast<int>(0.5 * volume.size_mm.x() / target.pitch_mm)),
        j(static_cast<int>(0.5 * volume.size_mm.y() / target.pitch_mm)) {}
  [[nodiscard]] bool contains(const NumberedDot& dot) const {
    return std::abs(dot.i) <= i && std::abs(dot.j) <= j;
  }
};

/// Number of dots of the volume that must be visible in this image, without those that may be cut
/// at its border.
int dots_in_sight(const TargetMap& map, const DotReach& reach, cv::Size size) {
  const double margin_px = map.pitch_px();
  int count = 0;
  for (int j = -reach.j; j <= reach.j; ++j) {
    for (int i = -reach.i; i <= reach.i; ++i) {
      const Pixel at = map(i, j);
      const bool in_sight = at.u_px > margin_px && at.u_px < size.width - margin_px &&
                            at.v_px > margin_px && at.v_px < size.height - margin_px;
      if (in_sight) ++count;
    }
  }
  return count;
}

ShotVerdict judge_numbers(const std::vector<Dot>& dots, const DotTarget& target,
                          ShotFigures figures, std::vector<NumberedDot>& numbered) {
  auto result = number_dots(dots, target);
  if (result) {
    numbered = *std::move(result);
    return {ShotFault::kNone, "", figures};
  }
  constexpr std::size_t kMinDots = 30;  // fewer dots do not determine a cubic in x and y
  if (dots.size() < kMinDots) {
    return refuse(ShotFault::kNoDots, fmt::format("{} dots found", dots.size()), figures);
  }
  if (is_mirrored(dots, target)) {
    return refuse(ShotFault::kMirrored, "the three large dots are arranged as in a mirror image",
                  figures);
  }
  return refuse(ShotFault::kMarkersHidden, result.error().message, figures);
}

}  // namespace

DotShot check_dots(const cv::Mat& image, const DotTarget& target, const MeasurementVolume& volume,
                   const ShotCheckOptions& options) {
  DotShot shot;
  const cv::Mat gray = linear_gray(image);
  const std::vector<Dot> dots = find_dots(gray);
  const ShotFigures figures = measure_dots(image, gray, dots);
  if (dots.empty()) {
    shot.verdict = refuse(ShotFault::kNoDots, "no dots found", figures);
    return shot;
  }
  const double widest_px = options.max_edge_width * median_diameter_px(dots);
  shot.verdict = judge_light({"dots", "edges of the dots"}, figures, widest_px, options);
  if (!shot.verdict.good()) return shot;
  std::vector<NumberedDot> numbered;
  shot.verdict = judge_numbers(dots, target, figures, numbered);
  if (!shot.verdict.good()) return shot;

  const TargetMap map(numbered);
  shot.origin = map(0, 0);
  shot.pitch_px = map.pitch_px();
  const DotReach reach(target, volume);
  const int asked = dots_in_sight(map, reach, image.size());
  const auto there = std::count_if(numbered.begin(), numbered.end(),
                                   [&](const NumberedDot& dot) { return reach.contains(dot); });
  if (static_cast<double>(there) < options.min_complete * asked) {
    shot.verdict =
        refuse(ShotFault::kNoDots,
               fmt::format("only {} of the {} dots in sight were found", there, asked), figures);
  }
  return shot;
}

}  // namespace flytri::calibration
