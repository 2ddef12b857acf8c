#include "core/calibration/fit/check_set.h"

#include <algorithm>
#include <cmath>

namespace flytri::calibration {
namespace {

/// Z has four coefficients; one more plane is needed to check the fit.
constexpr std::size_t kMinPlanes = 5;

Result<void> check_image(const cv::Mat& image, const std::string& name, const cv::Mat& first,
                         const std::string& first_name) {
  if (image.empty()) return fail(ErrorCode::kBadFormat, "{}: the image is empty", name);
  if (image.size() != first.size()) {
    return fail(
        ErrorCode::kInconsistent,
        "{} has {} x {} pixels, but {} has {} x {}; take all images of a camera in one size", name,
        image.cols, image.rows, first_name, first.cols, first.rows);
  }
  return {};
}

Result<void> check_plane(const CalibrationPlane& plane, const CalibrationPlane& first) {
  const auto first_error = [](std::initializer_list<Result<void>> results) -> Result<void> {
    for (const auto& result : results) {
      if (!result) return result;
    }
    return {};
  };
  return first_error({
      check_gray_image(plane.vertical, plane.vertical_name, first.vertical, first.vertical_name),
      check_gray_image(plane.horizontal, plane.horizontal_name, first.vertical,
                       first.vertical_name),
      check_gray_image(plane.dots, plane.dots_name, first.vertical, first.vertical_name),
      check_texture_image(plane.dots_texture, plane.dots_texture_name, first.dots_texture,
                          first.dots_texture_name),
  });
}

Result<void> check_depths(const std::vector<double>& z_mm, double depth_mm) {
  if (z_mm.size() < kMinPlanes) {
    return fail(ErrorCode::kInsufficient,
                "the set has {} planes, but a calibration needs at least {}; add planes",
                z_mm.size(), kMinPlanes);
  }
  for (std::size_t i = 0; i < z_mm.size(); ++i) {
    if (!std::isfinite(z_mm[i])) {
      return fail(ErrorCode::kInconsistent, "the z of plane {} is not a finite number", i);
    }
    if (i > 0 && !(z_mm[i] > z_mm[i - 1])) {
      return fail(ErrorCode::kInconsistent,
                  "the planes must be listed by rising z, but {} mm comes after {} mm", z_mm[i],
                  z_mm[i - 1]);
    }
  }
  const double span_mm = z_mm.back() - z_mm.front();
  if (span_mm < 0.8 * depth_mm) {
    return fail(
        ErrorCode::kInsufficient,
        "the planes cover {} mm of a volume {} mm deep; place planes from end to end of the volume",
        span_mm, depth_mm);
  }
  return {};
}

}  // namespace

Result<void> check_gray_image(const cv::Mat& image, const std::string& name, const cv::Mat& first,
                              const std::string& first_name) {
  if (auto good = check_image(image, name, first, first_name); !good) return good;
  if (image.type() == CV_8UC1 || image.type() == CV_16UC1) return {};
  return fail(ErrorCode::kBadFormat,
              "{}: images of the measurement camera must be 8- or 16-bit gray", name);
}

Result<void> check_texture_image(const cv::Mat& image, const std::string& name,
                                 const cv::Mat& first, const std::string& first_name) {
  if (first.empty() && image.empty()) return {};
  if (first.empty()) {
    return fail(ErrorCode::kInconsistent,
                "{}: there is no such image of the first placement; take it each time, or never",
                name);
  }
  if (!image.empty() && image.type() != CV_8UC3)
    return fail(ErrorCode::kBadFormat, "{}: texture images must be 8-bit RGB", name);
  return check_image(image, name, first, first_name);
}

Result<void> check_scene(const CalibrationScene& scene) {
  if (!(scene.volume.size_mm.minCoeff() > 0) || !scene.volume.size_mm.allFinite()) {
    return fail(ErrorCode::kInconsistent,
                "the size of the measurement volume must be above 0 in all directions");
  }
  if (*std::min_element(scene.line_counts.begin(), scene.line_counts.end()) < 1) {
    return fail(ErrorCode::kInconsistent, "each pattern must have at least one line");
  }
  const DotTarget& dots = scene.dots;
  const bool ordered = dots.diameter_mm > 0 && dots.marker_diameter_mm > dots.diameter_mm &&
                       dots.pitch_mm > dots.marker_diameter_mm;
  if (!ordered) {
    return fail(ErrorCode::kInconsistent,
                "dots must have 0 < diameter < marker diameter < pitch, not {}, {}, {} mm",
                dots.diameter_mm, dots.marker_diameter_mm, dots.pitch_mm);
  }
  return {};
}

Result<void> check_numbers(const CalibrationScene& scene, const std::vector<double>& z_mm) {
  if (auto good = check_scene(scene); !good) return good;
  return check_depths(z_mm, scene.volume.size_mm.z());
}

Result<void> check_set(const CalibrationSet& set) {
  std::vector<double> z_mm;
  for (const CalibrationPlane& plane : set.planes) z_mm.push_back(plane.z_mm);
  if (auto numbers = check_numbers(set, z_mm); !numbers) return numbers;
  for (const CalibrationPlane& plane : set.planes) {
    if (auto good = check_plane(plane, set.planes.front()); !good) return good;
  }
  return {};
}

}  // namespace flytri::calibration
