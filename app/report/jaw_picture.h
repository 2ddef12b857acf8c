/// @file  A picture of a jaw from above its teeth, colored by uncertainty, for a report.
#pragma once

#include <opencv2/core.hpp>

#include "core/geometry/jaw_axes.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::report {

/// Orthographic: the front is up, and the teeth face the viewer.
class JawPicture {
 public:
  /// @param width_px  >= 64; the height follows from the jaw
  /// @param max_sigma_mm  > 0, end of the color scale
  JawPicture(const TriangleMesh& mesh, const JawAxes& axes, int width_px, double max_sigma_mm);

  /// R, G, B; white where nothing was measured. The colors are those of the window: from blue (low)
  /// to orange; violet: a hole that was closed.
  [[nodiscard]] const cv::Mat& image() const { return image_; }
  /// Where a place of the jaw is in the picture, px.
  [[nodiscard]] Vec2 pixel_of(const Vec3& p_mm) const;
  [[nodiscard]] double px_per_mm() const { return px_per_mm_; }

 private:
  void draw(const TriangleMesh& mesh, double max_sigma_mm);

  Eigen::Matrix3d R_jaw_world_;
  Vec3 corner_mm_ = Vec3::Zero();  ///< upper left, frame of the jaw
  double px_per_mm_ = 1.0;
  cv::Mat image_;
};

}  // namespace flytri::report
