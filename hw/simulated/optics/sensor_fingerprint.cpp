#include "hw/simulated/optics/sensor_fingerprint.h"

#include "core/base/fingerprint.h"

namespace flytri::simulated {
namespace {

// The structured bindings below do not compile when a struct gets a new member, so that none is
// forgotten.
class SensorPrint {
 public:
  [[nodiscard]] std::uint64_t value() const { return print_.value(); }

  void add(double number) { print_.add(number); }
  void add(const ImageSize& size) {
    const auto& [width_px, height_px] = size;
    add_all(width_px, height_px);
  }
  void add(const Isometry& T) { add_range(T.matrix().reshaped()); }
  void add(const ThinLens& lens) {
    const auto& [aperture_radius_mm, focus_mm] = lens;
    add_all(aperture_radius_mm, focus_mm);
  }
  void add(const LensDistortion& distortion) {
    const auto& [k1, k2, p1, p2] = distortion;
    add_all(k1, k2, p1, p2);
  }
  void add(const CameraModel& camera) {
    const auto& [size, T_sensor_camera, focal_px, principal_px, distortion, lens, sigma_px] =
        camera;
    add_all(size, T_sensor_camera, focal_px, principal_px.x(), principal_px.y(), distortion, lens,
            sigma_px);
  }
  void add(const ProjectorModel& projector) {
    const auto& [pattern, T_sensor_projector, line_across, half_width, half_length, distortion,
                 lens, sigma] = projector;
    add_all(static_cast<int>(pattern), T_sensor_projector, line_across.size());
    add_range(line_across);
    add_all(half_width, half_length, distortion, lens, sigma);
  }
  void add(const ChipModel& chip) {
    const auto& [well_e, read_e, black, contrast, size_px, line, ambient] = chip;
    add_all(well_e, read_e, black, contrast, size_px, line, ambient);
  }
  void add(const calibration::DotTarget& dots) {
    const auto& [pitch_mm, diameter_mm, marker_mm] = dots;
    add_all(pitch_mm, diameter_mm, marker_mm);
  }
  void add(const SensorModel& sensor) {
    const auto& [volume, camera, texture_camera, projectors, chip, dots, exposure_s, period_s,
                 depth_sigma_mm] = sensor;
    add_range(volume.size_mm);
    add_all(camera, texture_camera, projectors[0], projectors[1], chip, dots, exposure_s, period_s,
            depth_sigma_mm);
  }

 private:
  template <typename... Parts>
  void add_all(const Parts&... parts) {
    (add(parts), ...);
  }
  template <typename Numbers>
  void add_range(const Numbers& numbers) {
    for (const double number : numbers) add(number);
  }

  Fingerprint print_;
};

}  // namespace

std::uint64_t fingerprint(const SensorModel& sensor) {
  SensorPrint print;
  print.add(sensor);
  return print.value();
}

}  // namespace flytri::simulated
