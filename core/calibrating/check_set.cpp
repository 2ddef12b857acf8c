#include "core/calibrating/check_set.h"

#include <algorithm>
#include <cmath>

namespace flytri {
namespace {

/// Z has four coefficients; one plane more tells whether they fit.
constexpr std::size_t kMinPlanes = 5;

Result<void> check_image(const cv::Mat& image, const std::string& name, const cv::Mat& first,
                         const std::string& first_name) {
  if (image.empty()) return fail(ErrorCode::kBadFormat, "{}: the image is empty", name);
  if (image.size() != first.size()) {
    return fail(ErrorCode::kInconsistent, "{} has {} x {} pixels, {} has {} x {}", name, image.cols,
                image.rows, first_name, first.cols, first.rows);
  }
  return {};
}

Result<void> check_gray(const cv::Mat& image, const std::string& name) {
  if (image.type() == CV_8UC1 || image.type() == CV_16UC1) return {};
  return fail(ErrorCode::kBadFormat,
              "{}: images of the measurement camera must be 8- or 16-bit gray", name);
}

Result<void> check_plane(const CalibrationPlane& plane, const CalibrationPlane& first) {
  const auto first_error = [](std::initializer_list<Result<void>> results) -> Result<void> {
    for (const auto& result : results) {
      if (!result) return result;
    }
    return {};
  };
  if (!std::isfinite(plane.z_mm)) {
    return fail(ErrorCode::kInconsistent, "the plane of {} has no finite z", plane.vertical_name);
  }
  if (plane.dots_texture.type() != CV_8UC3) {
    return fail(ErrorCode::kBadFormat, "{}: texture images must be 8-bit RGB",
                plane.dots_texture_name);
  }
  return first_error({
      check_image(plane.vertical, plane.vertical_name, first.vertical, first.vertical_name),
      check_image(plane.horizontal, plane.horizontal_name, first.vertical, first.vertical_name),
      check_image(plane.dots, plane.dots_name, first.vertical, first.vertical_name),
      check_image(plane.dots_texture, plane.dots_texture_name, first.dots_texture,
                  first.dots_texture_name),
      check_gray(plane.vertical, plane.vertical_name),
      check_gray(plane.horizontal, plane.horizontal_name),
      check_gray(plane.dots, plane.dots_name),
  });
}

Result<void> check_numbers(const CalibrationSet& set) {
  if (!(set.volume.size_mm.minCoeff() > 0) || !set.volume.size_mm.allFinite()) {
    return fail(ErrorCode::kInconsistent, "the measurement volume must be larger than nothing");
  }
  if (*std::min_element(set.line_counts.begin(), set.line_counts.end()) < 1) {
    return fail(ErrorCode::kInconsistent, "each pattern must have at least one line");
  }
  const DotTarget& dots = set.dots;
  const bool ordered = dots.diameter_mm > 0 && dots.marker_diameter_mm > dots.diameter_mm &&
                       dots.pitch_mm > dots.marker_diameter_mm;
  if (!ordered) {
    return fail(ErrorCode::kInconsistent,
                "dots must have 0 < diameter < marker diameter < pitch, not {}, {}, {} mm",
                dots.diameter_mm, dots.marker_diameter_mm, dots.pitch_mm);
  }
  return {};
}

}  // namespace

Result<void> check_set(const CalibrationSet& set) {
  if (auto numbers = check_numbers(set); !numbers) return numbers;
  if (set.planes.size() < kMinPlanes) {
    return fail(ErrorCode::kInsufficient, "{} planes, a calibration needs at least {}",
                set.planes.size(), kMinPlanes);
  }
  for (std::size_t i = 0; i < set.planes.size(); ++i) {
    if (auto plane = check_plane(set.planes[i], set.planes.front()); !plane) return plane;
    if (i > 0 && !(set.planes[i].z_mm > set.planes[i - 1].z_mm)) {
      return fail(ErrorCode::kInconsistent, "planes must be given by rising z; {} is out of order",
                  set.planes[i].vertical_name);
    }
  }
  const double span = set.planes.back().z_mm - set.planes.front().z_mm;
  if (span < 0.8 * set.volume.size_mm.z()) {
    return fail(ErrorCode::kInsufficient,
                "the planes span {} mm of a volume {} mm deep; calibrate from end to end", span,
                set.volume.size_mm.z());
  }
  return {};
}

}  // namespace flytri
