#include "core/meshing/widest_place.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace flytri::meshing {
namespace {

constexpr double kFinestPixel_mm = 0.02;
constexpr double kMostPixels = 1000.0;
/// Margin around the line, so that the image has pixels outside.
constexpr double kMargin_px = 2.0;
/// fillPoly takes fixed-point coordinates with this many fractional bits.
constexpr int kDigits = 6;
/// Error of the measured width: fillPoly also fills the pixels on the line, and the distance is to
/// the nearest pixel outside.
constexpr double kTooWide_px = 2.0;
/// Points at most this much farther than the nearest count as equally near.
constexpr double kNear_px = 2.0;

/// Image plane perpendicular to a direction; `corner_mm` is its upper left corner.
struct Sight {
  Vec3 right, down;
  Vec2 corner_mm;
  double pixel_mm = 0.0;
  Vec2 size_px;

  [[nodiscard]] Vec2 px(const Vec3& p_mm) const {
    return (Vec2(p_mm.dot(right), p_mm.dot(down)) - corner_mm) / pixel_mm;
  }
};

Sight sight_of(std::span<const Vec3> rim_mm, const Vec3& direction) {
  Sight sight;
  sight.right = direction.unitOrthogonal();
  sight.down = direction.cross(sight.right);
  Eigen::AlignedBox2d box;
  for (const Vec3& p : rim_mm) box.extend(Vec2(p.dot(sight.right), p.dot(sight.down)));
  sight.pixel_mm = std::max(kFinestPixel_mm, box.sizes().maxCoeff() / kMostPixels);
  sight.corner_mm = box.min() - Vec2::Constant(kMargin_px * sight.pixel_mm);
  sight.size_px = box.sizes() / sight.pixel_mm + Vec2::Constant(2.0 * kMargin_px + 1.0);
  return sight;
}

void fill(cv::Mat& image, const Sight& sight, std::span<const Vec3> line_mm, int value) {
  constexpr double kUnit = 1 << kDigits;
  std::vector<cv::Point> corners;
  for (const Vec3& p_mm : line_mm) {
    const Vec2 p = kUnit * sight.px(p_mm);
    corners.emplace_back(static_cast<int>(std::lround(p.x())),
                         static_cast<int>(std::lround(p.y())));
  }
  cv::fillPoly(image, std::vector<std::vector<cv::Point>>{corners}, value, cv::LINE_8, kDigits);
}

/// Mean height along the direction of the part of the line that is nearest to a pixel.
double height_mm(const Sight& sight, std::span<const Vec3> line_mm, const Vec3& direction,
                 const Vec2& from_px) {
  double nearest_px = std::numeric_limits<double>::infinity();
  for (const Vec3& p : line_mm) nearest_px = std::min(nearest_px, (sight.px(p) - from_px).norm());
  double sum_mm = 0.0;
  int count = 0;
  for (const Vec3& p : line_mm) {
    if ((sight.px(p) - from_px).norm() > nearest_px + kNear_px) continue;
    sum_mm += p.dot(direction);
    ++count;
  }
  return sum_mm / count;
}

}  // namespace

WidestPlace widest_place(std::span<const Vec3> rim_mm,
                         std::span<const std::span<const Vec3>> islands_mm, const Vec3& direction) {
  if (rim_mm.empty()) return {};
  if (direction.isZero(0.0)) return {0.0, rim_mm.front()};
  const Sight sight = sight_of(rim_mm, direction);
  cv::Mat open = cv::Mat::zeros(static_cast<int>(sight.size_px.y()),
                                static_cast<int>(sight.size_px.x()), CV_8U);
  fill(open, sight, rim_mm, 255);
  for (const std::span<const Vec3> island : islands_mm) fill(open, sight, island, 0);
  cv::Mat distances_px;
  cv::distanceTransform(open, distances_px, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  double farthest_px = 0.0;
  cv::Point at;
  cv::minMaxLoc(distances_px, nullptr, &farthest_px, nullptr, &at);
  const Vec2 center_px(at.x, at.y);
  const Vec2 center_mm = sight.corner_mm + sight.pixel_mm * center_px;
  return {std::max(0.0, 2.0 * farthest_px - kTooWide_px) * sight.pixel_mm,
          center_mm.x() * sight.right + center_mm.y() * sight.down +
              height_mm(sight, rim_mm, direction, center_px) * direction};
}

}  // namespace flytri::meshing
