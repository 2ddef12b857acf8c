/// @file  Finds the points that a texture frame observes, and their colors.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/geometry/point_cloud.h"

namespace flytri::texture {

/// A texture image and the pose of the sensor.
struct TextureFrame {
  cv::Mat image;  ///< CV_8UC3, R, G, B order, sRGB, Calibration::texture_size
  Isometry T_world_sensor = Isometry::Identity();
};

struct TextureOptions {
  /// 0..1. Least cosine between the surface normal and the direction to the texture camera. Below
  /// it, the point does not count as observed, because its pixel covers neighboring surface too.
  double min_facing_cosine = 0.25;
  /// >= 1. Edge of a cell of the z-buffer, px: points in one cell are on the same ray of sight. A
  /// few times the distance of neighboring points in the image.
  int depth_cell_px = 6;
  /// > 0. Points farther than this behind the closest point of their cell are hidden, as a share of
  /// the volume's depth.
  double depth_tolerance_share = 0.04;
  /// >= 0. The calibration is used up to this distance outside the measurement volume, as a share
  /// of its size.
  double volume_margin_share = 0.1;
  /// 1..255. A pixel with a brighter channel is saturated and ignored.
  int max_channel = 250;
  /// >= 0. Points that no frame observed get the color of the nearest observed point within this
  /// share of the volume's width; the others stay untextured.
  double extend_share = 0.1;

  [[nodiscard]] Result<void> validate() const;
};

/// The observed color of one point: average chromaticity and highest intensity.
class ObservedColor {
 public:
  /// @param light  linear light of one observing pixel; black is ignored
  void add(const Vec3f& light);
  [[nodiscard]] bool observed() const { return count_ > 0; }
  /// The point must have been observed.
  [[nodiscard]] Rgb color() const;

 private:
  Vec3f chromaticity_ = Vec3f::Zero();  ///< sum of colors divided by their intensity
  float highest_intensity_ = 0.0F;
  int count_ = 0;
};

/// Resolution of the surface at a point in a texture frame of this pose, in pixels per mm^2: higher
/// if the camera is nearer and looks more directly at the surface. 0 if the point is out of sight.
/// Does not check whether other points hide it.
[[nodiscard]] double pixels_per_mm2(const SurfacePoint& point, const Isometry& T_sensor_world,
                                    const calibration::Calibration& calibration,
                                    const TextureOptions& options);

/// Whether an image is one of the calibrated texture camera.
/// @errors  kBadFormat: not CV_8UC3; kInconsistent: its size differs from the calibration.
[[nodiscard]] Result<void> check_texture_image(const cv::Mat& image,
                                               const calibration::Calibration& calibration);

/// Adds the light that the frame saw to each point's color. A pixel observes the closest points on
/// its ray of sight.
/// @param points  world frame
/// @param colors  of the same points
/// @source  Arold et al., "Texture Acquisition and Mapping": observing pixels, observed points,
///          z-buffer, average color and highest intensity.
/// @errors  As check_texture_image.
[[nodiscard]] Result<void> observe_points(std::span<const SurfacePoint> points,
                                          std::span<ObservedColor> colors,
                                          const TextureFrame& frame,
                                          const calibration::Calibration& calibration,
                                          const TextureOptions& options, const Workers& workers);

}  // namespace flytri::texture
