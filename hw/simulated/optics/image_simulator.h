/// @file  The images that a real sensor would take of a mesh, with all that light does to them.
///
/// Thin lenses with finite apertures: lines and image blur with the distance from focus, shadows
/// have penumbras. Lambertian surfaces, motion during the exposure, room light, speckle, shot and
/// read noise. Nothing here knows how a calibration describes a sensor.
/// @source  Arold et al., "Physical Optimization" and "Texture Acquisition and Mapping".
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {

/// kEveryPixel: each pixel near a line is traced. kGrid: every fourth, the rest interpolated where
/// the surface allows, and noise from a store: for images in real time, see grid_light.h.
enum class Tracing { kEveryPixel, kGrid };

struct ImageOptions {
  int bits = 8;        ///< 8 or 16, of measurement frames
  bool noise = true;   ///< off: what an endless exposure would show
  bool motion = true;  ///< off: the sensor rests during each exposure
  int exposures = 1;   ///< 1..1000, averaged into one image
  Tracing tracing = Tracing::kEveryPixel;
  std::uint64_t seed = 1;
  [[nodiscard]] Result<void> validate() const;
};

/// A sensor in front of a mesh. Immutable and thread-safe; an image depends on its arguments alone.
class ImageSimulator {
 public:
  /// @param mesh  model frame, mm; vertex colors are its albedo
  /// @errors  kBadOption for a sensor or options that cannot be, kInsufficient for an empty mesh.
  [[nodiscard]] static Result<ImageSimulator> create(const TriangleMesh& mesh,
                                                     const SensorModel& sensor,
                                                     const ImageOptions& options = {});

  /// A measurement frame around `time_s` on the path. `stream` numbers the frame's noise.
  /// @return  CV_8UC1 or CV_16UC1, linear in light
  [[nodiscard]] cv::Mat measurement_image(Pattern pattern, const SensorPath& path, double time_s,
                                          std::uint64_t stream) const;

  /// A texture frame: white flash at the texture camera, too short for motion.
  /// @return  CV_8UC3, R, G, B order, sRGB
  [[nodiscard]] cv::Mat texture_image(const Isometry& T_model_sensor, std::uint64_t stream) const;

  [[nodiscard]] const SensorModel& sensor() const;
  [[nodiscard]] const RayScene& scene() const;

 private:
  struct Parts;
  explicit ImageSimulator(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_;
};

}  // namespace flytri::simulated
