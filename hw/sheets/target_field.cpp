#include "hw/sheets/target_field.h"

namespace flytri::sheets {

Field seen_field(const simulated::CameraModel& camera, double z_mm) {
  // Distortion bends the borders: places between the corners count, too.
  constexpr int kSteps = 16;
  const Vec3 center = camera.center();
  Field field;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      if (i % kSteps != 0 && j % kSteps != 0) continue;
      const Pixel pixel{static_cast<double>(i) / kSteps * camera.size.width_px - 0.5,
                        static_cast<double>(j) / kSteps * camera.size.height_px - 0.5};
      const Vec3 direction = camera.direction(pixel);
      const Vec3 place = center + (z_mm - center.z()) / direction.z() * direction;
      field.extend(Vec2(place.head<2>()));
    }
  return field;
}

Field target_field(const simulated::SensorModel& sensor, double z_mm) {
  Field field = seen_field(sensor.camera, z_mm);
  const Vec2 half_mm = 0.5 * sensor.volume.size_mm.head<2>();
  field.extend(half_mm);
  field.extend(Vec2(-half_mm));
  return field;
}

}  // namespace flytri::sheets
