/// @file  Simulates the images that a real sensor would take of a mesh.
///
/// Simulates thin lenses with finite apertures (defocus of lines and image, penumbras), Lambertian
/// surfaces, motion during the exposure, room light, speckle, shot and read noise. It does not use
/// the polynomials of the calibration.
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

/// kEveryPixel: traces each pixel near a line. kGrid: traces every fourth pixel, interpolates the
/// others where the surface is smooth, and takes noise from a table; for real time, see
/// grid_light.h.
enum class Tracing { kEveryPixel, kGrid };

struct ImageOptions {
  int bits = 8;        ///< 8 or 16, of measurement frames
  bool noise = true;   ///< false: the image without noise
  bool motion = true;  ///< false: the sensor rests during each exposure
  /// >= 0, delay of the last row after the first (rolling shutter); 0: global shutter. Of
  /// measurement frames; only for Tracing::kEveryPixel.
  double readout_s = 0.0;
  int exposures = 1;  ///< 1..1000, averaged into one image
  Tracing tracing = Tracing::kEveryPixel;
  std::uint64_t seed = 1;
  [[nodiscard]] Result<void> validate() const;
};

/// A sensor in front of a mesh. Immutable and thread-safe; an image depends only on the arguments.
class ImageSimulator {
 public:
  /// @param mesh  model frame, mm; vertex colors are its albedo
  /// @errors  kBadOption: invalid sensor or options; kInsufficient: empty mesh.
  [[nodiscard]] static Result<ImageSimulator> create(const TriangleMesh& mesh,
                                                     const SensorModel& sensor,
                                                     const ImageOptions& options = {});

  /// A measurement frame with the middle of its exposure at `time_s` on the path; with a rolling
  /// shutter, that of the middle row. `stream` is the random stream of its noise.
  /// @return  CV_8UC1 or CV_16UC1, linear in light
  [[nodiscard]] cv::Mat measurement_image(Pattern pattern, const SensorPath& path, double time_s,
                                          std::uint64_t stream) const;

  /// A texture frame under a white flash at the texture camera, without motion blur.
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
