/// @file  The camera of the scene: orbits, pans and zooms by pixels, and flies to a pose.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace flytri::ui {

/// Pose of the eye. The eye frame is that of OpenGL: x right, y up, looking along -z.
struct CameraPose {
  Vec3 target_mm = Vec3::Zero();  ///< world: what the middle of the picture shows
  Eigen::Quaterniond q_world_eye = Eigen::Quaterniond::Identity();
  double height_mm = 100.0;  ///< > 0, of the world in the picture at the target's depth
};

struct CameraOptions {
  /// 0.01..2, angle between the upper and lower border. Narrow is near to orthographic: distances
  /// on the surface can be compared by eye.
  double field_of_view_rad = 0.35;
  double orbit_rad_per_height = 3.14;  ///< > 0, turn for a drag over the picture's height
  double min_height_mm = 1.0;          ///< > 0, the nearest that zoom goes
  double max_height_mm = 2000.0;       ///< > min_height_mm: the face sensor sees 200 mm
  [[nodiscard]] Result<void> validate() const;
};

/// The size of the picture in framebuffer pixels.
struct PictureSize {
  int width_px = 1;
  int height_px = 1;
  bool operator==(const PictureSize&) const = default;
  [[nodiscard]] double aspect() const { return static_cast<double>(width_px) / height_px; }
};

class OrbitCamera {
 public:
  explicit OrbitCamera(const CameraOptions& options = {});

  [[nodiscard]] const CameraPose& pose() const { return pose_; }
  /// Moves there at once, and ends a flight.
  void set_pose(const CameraPose& pose);

  /// Turns about a point, as if the pointer dragged the model. Ends a flight.
  void orbit(double dx_px, double dy_px, const PictureSize& size, const Vec3& pivot_mm);
  /// Turns about the target.
  void orbit(double dx_px, double dy_px, const PictureSize& size);
  /// Turns about the line of sight, counter-clockwise in the picture.
  void roll(double angle_rad);
  /// Moves parallel to the picture: the point under the pointer stays under it.
  void pan(double dx_px, double dy_px, const PictureSize& size);
  /// `factor` > 1 enlarges.
  void zoom(double factor);
  /// Zooms; the point under the given pixel (from the upper left) stays there.
  void zoom_at(double factor, double x_px, double y_px, const PictureSize& size);

  /// Starts a flight that ends at `pose` after `duration_s`; 0 moves there at once.
  void fly_to(const CameraPose& pose, double duration_s);
  /// Continues a flight. @return  true while the camera moves
  bool advance(double dt_s);
  /// The end of the flight, or the current pose.
  [[nodiscard]] const CameraPose& destination() const { return is_flying() ? to_ : pose_; }
  [[nodiscard]] bool is_flying() const { return remaining_s_ > 0.0; }

  /// The pose in the direction of `q_world_eye` that just shows all points.
  /// @param points_mm  world frame, the corners of a box for instance
  [[nodiscard]] CameraPose fitting(std::span<const Vec3> points_mm,
                                   const Eigen::Quaterniond& q_world_eye,
                                   const PictureSize& size) const;

  [[nodiscard]] const CameraOptions& options() const { return options_; }
  [[nodiscard]] double distance_mm() const;  ///< from the eye to the target
  [[nodiscard]] Isometry T_world_eye() const;
  /// Eye to clip coordinates. @param near_mm, far_mm  distances from the eye, 0 < near < far
  [[nodiscard]] Eigen::Matrix4d projection(double aspect, double near_mm, double far_mm) const;
  /// The ray through a pixel's middle: origin at the eye, unit direction, world frame.
  [[nodiscard]] Eigen::ParametrizedLine<double, 3> ray(double x_px, double y_px,
                                                       const PictureSize& size) const;

 private:
  CameraOptions options_;
  CameraPose pose_;
  CameraPose from_, to_;  ///< of the flight
  double duration_s_ = 0.0;
  double remaining_s_ = 0.0;
};

/// Looking through the sensor: the measurement volume fills the picture.
[[nodiscard]] CameraPose pose_through_sensor(const Isometry& T_world_sensor, const Vec3& volume_mm);

/// Looks at a surface point along its normal, with `up` as upright as possible.
[[nodiscard]] CameraPose pose_facing(const Vec3& point_mm, const Vec3& normal, const Vec3& up,
                                     double height_mm);

}  // namespace flytri::ui
