/// @file  Camera and picture size, as the shaders need them.
#pragma once

#include <Eigen/Geometry>

#include "ui/gpu/pixel_box.h"
#include "ui/gpu/shader_program.h"
#include "ui/scene/orbit_camera.h"

namespace flytri::ui {

[[nodiscard]] PixelBox whole_picture(const PictureSize& size);

struct Eye {
  PictureSize size;
  Eigen::Matrix4f T_eye_world = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f P_clip_eye = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f P_clip_world = Eigen::Matrix4f::Identity();  ///< of the two above
  double distance_mm = 1.0;  ///< from the eye to the camera's target
  double height_mm = 1.0;    ///< of the world in the picture at the target
  bool operator==(const Eye&) const = default;

  [[nodiscard]] Eigen::Vector2f size_px() const {
    return Eigen::Vector2i(size.width_px, size.height_px).cast<float>();
  }
  /// From a slope against the line of sight to pixels.
  [[nodiscard]] Eigen::Vector2f focal_px() const;
  /// The change of the normalized depth for 1 mm towards the eye, at the target.
  [[nodiscard]] float depth_per_mm() const;
  void set_uniforms(const ShaderProgram& program) const;
  /// False only if no part of the box is in the picture.
  [[nodiscard]] bool may_see(const Eigen::AlignedBox3f& box_mm) const;
  /// The pixels that a box may cover.
  [[nodiscard]] PixelBox pixels_of(const Eigen::AlignedBox3f& box_mm) const;
};

/// The near and far planes enclose `box_mm` with room to grow, so that they rarely change.
[[nodiscard]] Eye make_eye(const OrbitCamera& camera, const PictureSize& size,
                           const Eigen::AlignedBox3d& box_mm);

/// World point of a pixel (from the upper left) and its value in the depth buffer.
[[nodiscard]] Vec3 unprojected(const Eye& eye, double x_px, double y_px, double depth);

}  // namespace flytri::ui
