/// @file  Simulates the images of both cameras under each light of a rig.
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "hw/device/light_switch.h"
#include "hw/simulated/optics/image_simulator.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {

/// A sensor that moves over a mesh. Immutable and thread-safe; an image depends only on light and
/// time.
class LitScene {
 public:
  /// @errors  As ImageSimulator::create and plan_path.
  [[nodiscard]] static Result<LitScene> create(const TriangleMesh& mesh, const SensorModel& sensor,
                                               const PathOptions& path,
                                               const ImageOptions& options);

  /// @param time_s  path time at the middle of the exposure
  /// @return  CV_8UC1 or CV_16UC1
  [[nodiscard]] cv::Mat measurement_image(device::Light light, double time_s) const;
  /// @return  CV_8UC3, R, G, B order; black except under the flash
  [[nodiscard]] cv::Mat texture_image(device::Light light, double time_s) const;
  [[nodiscard]] const SensorPath& path() const { return path_; }

 private:
  LitScene(ImageSimulator lines, ImageSimulator dark, ImageSimulator flash, SensorPath path)
      : lines_(std::move(lines)),
        dark_(std::move(dark)),
        flash_(std::move(flash)),
        path_(std::move(path)) {}

  ImageSimulator lines_, dark_, flash_;
  SensorPath path_;
};

}  // namespace flytri::simulated
