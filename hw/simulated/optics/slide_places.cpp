#include "hw/simulated/optics/slide_places.h"

#include <cmath>

#include "hw/simulated/optics/slide_light.h"

namespace flytri::simulated {

SlidePlaces::SlidePlaces(const ProjectorModel& projector, const Vec3& camera_center_mm)
    : R_projector_sensor_(projector.T_sensor_projector.linear().transpose().cast<float>()),
      camera_in_projector_mm_(
          (projector.T_sensor_projector.inverse() * camera_center_mm).cast<float>()),
      k1_(static_cast<float>(projector.distortion.k1)),
      k2_(static_cast<float>(projector.distortion.k2)),
      p1_(static_cast<float>(projector.distortion.p1)),
      p2_(static_cast<float>(projector.distortion.p2)),
      aperture_radius_mm_(static_cast<float>(projector.lens.aperture_radius_mm)),
      focus_mm_(static_cast<float>(projector.lens.focus_mm)),
      half_length_along_(static_cast<float>(projector.half_length_along)),
      lines_(projector.line_across.begin(), projector.line_across.end()) {}

// As LensDistortion::undistort. The distortion is small, so two steps of Newton's method give full
// single precision.
std::array<SlidePlaces::Numbers, 2> SlidePlaces::undistort(const Numbers& x_distorted,
                                                           const Numbers& y_distorted) const {
  Numbers x = x_distorted;
  Numbers y = y_distorted;
  for (int step = 0; step < 2; ++step) {
    const Numbers r2 = x * x + y * y;
    const Numbers radial = 1.0F + r2 * (k1_ + r2 * k2_);
    const Numbers slope = 2.0F * k1_ + 4.0F * k2_ * r2;
    const Numbers xy = x * y;
    const Numbers rest_x = x_distorted - (x * radial + 2.0F * p1_ * xy + p2_ * (r2 + 2.0F * x * x));
    const Numbers rest_y = y_distorted - (y * radial + p1_ * (r2 + 2.0F * y * y) + 2.0F * p2_ * xy);
    const Numbers mixed = slope * xy + 2.0F * (p1_ * x + p2_ * y);
    const Numbers xx = radial + slope * x * x + 2.0F * p1_ * y + 6.0F * p2_ * x;
    const Numbers yy = radial + slope * y * y + 6.0F * p1_ * y + 2.0F * p2_ * x;
    const Numbers scale = 1.0F / (xx * yy - mixed * mixed);
    x += (yy * rest_x - mixed * rest_y) * scale;
    y += (xx * rest_y - mixed * rest_x) * scale;
  }
  return {x, y};
}

SlidePlaces::Places SlidePlaces::find(const RayPacket& packet) const {
  Places places;
  const RayPacket::Vectors& view = packet.directions;
  const RayPacket::Vectors& normal = packet.normals;
  places.facing = -(view[0] * normal[0] + view[1] * normal[1] + view[2] * normal[2]);
  const auto met = packet.distances_mm.isFinite();
  // An arbitrary distance for rays without a hit, so that all numbers stay finite.
  const Numbers distance_mm = met.select(packet.distances_mm, 1.0F);
  RayPacket::Vectors p = rotated(R_projector_sensor_, view);
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = camera_in_projector_mm_[axis] + distance_mm * p[axis];
  const auto [across, along] = undistort(p[0] / p[2], p[1] / p[2]);
  places.across = across;
  places.blur = aperture_radius_mm_ / focus_mm_ * (p[2] - focus_mm_).abs() / p[2];
  places.seen = met && places.facing >= static_cast<float>(SlideLight::kMinCosine) && p[2] > 0.0F &&
                along.abs() <= half_length_along_;
  places.offset = across - lines_.front();
  places.before = Numbers::Zero();
  for (const float line : lines_) {
    const Numbers from_line = across - line;
    places.before += (from_line > 0.0F).cast<float>();
    places.offset = (from_line.abs() < places.offset.abs()).select(from_line, places.offset);
  }
  return places;
}

}  // namespace flytri::simulated
