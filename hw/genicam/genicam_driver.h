/// @file  Reaches USB3 Vision and GigE Vision cameras through Aravis.
#pragma once

#include <memory>

#include "hw/stream/camera_driver.h"

namespace flytri::genicam {

struct GenicamDriverOptions {
  /// Also lists the camera that Aravis simulates, for tests.
  bool has_simulated = false;
};

/// Formats have their V4L2 names. Gain is in the camera's units, mostly dB. Controls have their
/// GenICam names.
class GenicamDriver final : public stream::CameraDriver {
 public:
  explicit GenicamDriver(const GenicamDriverOptions& options = {}) : options_(options) {}

  /// Asks the network, too, which takes about a second.
  [[nodiscard]] std::vector<device::CameraDescription> list() override;
  [[nodiscard]] Result<stream::FoundCamera> find(const device::CameraMatch& match) override;
  [[nodiscard]] std::vector<Error> check(const device::CameraMatch& match,
                                         const device::CameraSettings& settings) override;
  [[nodiscard]] Result<std::unique_ptr<stream::ImageStream>> open(
      const device::CameraMatch& match, const device::CameraSettings& settings,
      int buffers) override;

 private:
  const GenicamDriverOptions options_;
};

}  // namespace flytri::genicam
