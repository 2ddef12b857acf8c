/// @file  Computes, for eight points at once, the places on a projector's slide that light them.
#pragma once

#include <vector>

#include "hw/simulated/optics/ray_packet.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// SlideLight::point for eight points at once, in single precision. Immutable.
class SlidePlaces {
 public:
  using Numbers = RayPacket::Numbers;

  /// @param camera_center_mm  origin of the rays, sensor frame
  SlidePlaces(const ProjectorModel& projector, const Vec3& camera_center_mm);

  /// Places on the slide, as tangents.
  struct Places {
    Numbers across;
    Numbers blur;    ///< radius of the projector's blur disk
    Numbers offset;  ///< from the nearest line
    Numbers before;  ///< number of lines before the place
    Numbers facing;  ///< cosine between the surface's normal and the line of sight
    /// Whether SlideLight::point would return a point.
    Eigen::Array<bool, RayPacket::kSize, 1> seen;
  };
  /// @param packet  traced rays, sensor frame
  [[nodiscard]] Places find(const RayPacket& packet) const;

 private:
  [[nodiscard]] std::array<Numbers, 2> undistort(const Numbers& x, const Numbers& y) const;

  Eigen::Matrix3f R_projector_sensor_;
  Vec3f camera_in_projector_mm_;
  float k1_, k2_, p1_, p2_;
  float aperture_radius_mm_, focus_mm_, half_length_along_;
  std::vector<float> lines_;
};

}  // namespace flytri::simulated
