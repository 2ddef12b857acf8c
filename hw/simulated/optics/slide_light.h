/// @file  From a point that the camera sees on a surface to the light that a projector's lines send
/// there.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hw/simulated/optics/lens_blur.h"
#include "hw/simulated/optics/line_profile.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// What one exposure looks at.
struct LineExposure {
  const RayScene& scene;
  std::span<const float> albedo;     ///< 0..1, by vertex of the scene's mesh
  std::span<const Vec3> directions;  ///< of the camera's pixels, row by row, sensor frame;
                                     ///< GridLight needs none
  const LensBlur& camera_blur;
  Isometry T_model_sensor;              ///< at the middle of the exposure
  std::vector<Isometry> T_then_middle;  ///< at equal times: the middle's sensor frame to theirs
};

/// A point in sight of the camera and before the projector; sensor frame.
struct SlidePoint {
  Vec3 position_mm;
  Vec3 normal;
  Vec3 view;            ///< unit, from the camera to the point
  Vec3 p_projector;     ///< the point in the projector's frame, mm; its z is the distance
  double across = 0.0;  ///< place on the slide that lights it
  double blur = 0.0;    ///< radius of the projector's defocus there, as a tangent
};

/// The light of one pattern. Immutable.
class SlideLight {
 public:
  /// Surfaces this steep, to the light or to the camera, send hardly any light.
  static constexpr double kMinCosine = 0.02;

  SlideLight(const SensorModel& sensor, Pattern pattern);

  /// @param view  unit, from the camera to the hit, sensor frame
  /// @return  none where the surface is too steep for the camera or the slide's lines have ended
  [[nodiscard]] std::optional<SlidePoint> point(const LineExposure& exposure, const Vec3& view,
                                                const RayHit& hit) const;

  /// The point that a ray of the camera met, where it is known to be seen and what lights it.
  /// @param across, blur  as in SlidePoint
  [[nodiscard]] SlidePoint point(const Vec3& position_mm, const Vec3& normal, const Vec3& view,
                                 double across, double blur) const;

  /// From the nearest line's middle to a place on the slide.
  [[nodiscard]] double from_nearest_line(double across) const;
  /// Beyond this distance from a line's middle no light arrives, whatever the motion.
  [[nodiscard]] double reach(double blur) const;

  /// By how much the slide's place that lights the point's pixel differs at another moment: the
  /// pixel's ray then meets the surface's tangent plane elsewhere.
  [[nodiscard]] double shift(const SlidePoint& point, const Isometry& T_then_middle) const;

  /// What of the slide's light arrives at the camera: albedo, cosine, distance. Share of full
  /// scale.
  [[nodiscard]] double brightness(const LineExposure& exposure, const SlidePoint& point,
                                  const RayHit& hit) const;

  /// The light that arrives at the camera from the nearest line, mean over the exposure's moments,
  /// were there no shadow. Share of full scale.
  [[nodiscard]] double light(const LineExposure& exposure, const SlidePoint& point,
                             const RayHit& hit) const;

  /// Whether something stands between the point and the middle of the projector's pupil.
  [[nodiscard]] bool shadowed(const LineExposure& exposure, const SlidePoint& point) const;

  /// Share of the light from the nearest line that passes what hides part of the pupil.
  [[nodiscard]] double penumbra_share(const LineExposure& exposure, const SlidePoint& point) const;

  [[nodiscard]] const ProjectorModel& projector() const { return projector_; }
  [[nodiscard]] const LineProfile& profile() const { return profile_; }

 private:
  ProjectorModel projector_;
  LineProfile profile_;
  Eigen::Matrix3d R_projector_sensor_;
  Vec3 center_mm_;  // of the projector's pupil
  double focal_px_;
  double gain_ = 1.0;  // full scale by brightness on a white surface at the middle of the volume
};

}  // namespace flytri::simulated
