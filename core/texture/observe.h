/// @file  Which points a texture frame observes, and the light that it saw there.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/geometry/point_cloud.h"

namespace flytri::texture {

/// A texture image and where the sensor was when it was taken.
struct TextureFrame {
  cv::Mat image;  ///< CV_8UC3, R, G, B order, sRGB, of the calibration's texture size
  Isometry T_world_sensor = Isometry::Identity();
};

struct TextureOptions {
  /// 0..1. A point whose surface turns away from the texture camera, with a smaller cosine to its
  /// ray of sight, is not observed: its pixel mixes with what lies beside it.
  double min_facing_cosine = 0.25;
  /// >= 1. Edge of a cell of the z-buffer, px: points that project into one cell lie on one ray of
  /// sight. A few times the distance of neighboring points in the image.
  int depth_cell_px = 6;
  /// > 0. Points farther than this behind the closest of their cell are in its shadow, as a share
  /// of the volume's depth.
  double depth_tolerance_share = 0.04;
  /// >= 0. The calibration holds this far outside the measurement volume, as a share of its size.
  double volume_margin_share = 0.1;
  /// 1..255. A pixel with a brighter channel is saturated and tells no color.
  int max_channel = 250;
  /// >= 0. Points that no frame observed take the color of the nearest observed one within this
  /// share of the volume's width; others stay untextured.
  double extend_share = 0.1;

  [[nodiscard]] Result<void> validate() const;
};

/// What the frames told about one point so far: average chromaticity and highest intensity.
class ObservedColor {
 public:
  /// @param light  linear, of one observing pixel; black tells nothing and is passed over
  void add(const Vec3f& light);
  [[nodiscard]] bool observed() const { return count_ > 0; }
  /// The point must have been observed.
  [[nodiscard]] Rgb color() const;

 private:
  Vec3f chromaticity_ = Vec3f::Zero();  ///< sum of colors divided by their intensity
  float highest_intensity_ = 0.0F;
  int count_ = 0;
};

/// How finely a texture frame from a place shows the surface at a point, in pixels per mm^2: the
/// more, the nearer and the more squarely it looks at it. 0 where the point is out of its sight;
/// other points that may stand between are not looked for.
[[nodiscard]] double pixels_per_mm2(const SurfacePoint& point, const Isometry& T_sensor_world,
                                    const calibration::Calibration& calibration,
                                    const TextureOptions& options);

/// Adds to each point's color what the frame saw there. A pixel observes the points closest to it
/// on its ray of sight.
/// @param points  world frame
/// @param colors  of the same points
/// @source  Arold et al., "Texture Acquisition and Mapping": observing pixels, observed points,
///          z-buffer, average color and highest intensity.
/// @errors  kInconsistent: the image has not the calibration's texture size.
[[nodiscard]] Result<void> observe_points(std::span<const SurfacePoint> points,
                                          std::span<ObservedColor> colors,
                                          const TextureFrame& frame,
                                          const calibration::Calibration& calibration,
                                          const TextureOptions& options, const Workers& workers);

}  // namespace flytri::texture
