/// @file  Computes the light of a projector's lines at a surface point that the camera sees.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hw/simulated/optics/lens_blur.h"
#include "hw/simulated/optics/line_profile.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Scene and poses of one exposure.
struct LineExposure {
  const RayScene& scene;
  std::span<const float> albedo;     ///< 0..1, by vertex of the scene's mesh
  std::span<const Vec3> directions;  ///< of the camera's pixels, row by row, sensor frame;
                                     ///< unused by GridLight
  const LensBlur& camera_blur;
  Isometry T_model_sensor;  ///< at the middle of the exposure
  /// At equal time steps: from the sensor frame of the middle to theirs.
  std::vector<Isometry> T_then_middle;
  /// Rows of the image that are needed; unused by GridLight. Of the others, some are computed.
  cv::Range rows = cv::Range::all();
};

/// A point that the camera sees, in front of the projector; sensor frame.
struct SlidePoint {
  Vec3 position_mm;
  Vec3 normal;
  Vec3 view;            ///< unit, from the camera to the point
  Vec3 p_projector;     ///< the point in the projector's frame, mm; its z is the distance
  double across = 0.0;  ///< place on the slide that lights the point
  double blur = 0.0;    ///< radius of the projector's blur disk at the point, as a tangent
};

/// Computes the light of one pattern. Immutable.
class SlideLight {
 public:
  /// Surfaces steeper than this, relative to light or camera, are ignored: they reflect hardly any
  /// light.
  static constexpr double kMinCosine = 0.02;

  SlideLight(const SensorModel& sensor, Pattern pattern);

  /// @param view  unit, from the camera to the hit, sensor frame
  /// @return  none if the surface is too steep for the camera, or outside the ends of the lines
  [[nodiscard]] std::optional<SlidePoint> point(const LineExposure& exposure, const Vec3& view,
                                                const RayHit& hit) const;

  /// The point hit by a ray of the camera, if visibility and place on the slide are already known.
  /// @param across, blur  as in SlidePoint
  [[nodiscard]] SlidePoint point(const Vec3& position_mm, const Vec3& normal, const Vec3& view,
                                 double across, double blur) const;

  /// Distance from the middle of the nearest line to a place on the slide.
  [[nodiscard]] double from_nearest_line(double across) const;
  /// Largest distance from a line's middle with light, including motion.
  [[nodiscard]] double reach(double blur) const;

  /// Shift of the place on the slide for the point's pixel at another time of the exposure. The
  /// pixel's ray then meets the tangent plane of the surface at another point.
  [[nodiscard]] double shift(const SlidePoint& point, const Isometry& T_then_middle) const;

  /// Share of the slide's light that reaches the camera, from albedo, cosine and distance; share of
  /// full scale.
  [[nodiscard]] double brightness(const LineExposure& exposure, const SlidePoint& point,
                                  const RayHit& hit) const;

  /// The light of the nearest line that reaches the camera, averaged over the exposure, without
  /// shadows. Share of full scale.
  [[nodiscard]] double light(const LineExposure& exposure, const SlidePoint& point,
                             const RayHit& hit) const;

  /// Whether something blocks the light from the middle of the projector's pupil to the point.
  [[nodiscard]] bool shadowed(const LineExposure& exposure, const SlidePoint& point) const;

  /// Share of the light of the nearest line that arrives when a part of the pupil is hidden.
  [[nodiscard]] double penumbra_share(const LineExposure& exposure, const SlidePoint& point) const;

  [[nodiscard]] const ProjectorModel& projector() const { return projector_; }
  [[nodiscard]] const LineProfile& profile() const { return profile_; }

 private:
  ProjectorModel projector_;
  LineProfile profile_;
  Eigen::Matrix3d R_projector_sensor_;
  Vec3 center_mm_;  // of the projector's pupil
  double focal_px_;
  double gain_ = 1.0;  // scales the light so that a white surface in the middle of the volume has
                       // the chip's line_level
};

}  // namespace flytri::simulated
