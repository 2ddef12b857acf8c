/// @file  Interface of what reaches cameras: finds, lists, checks and opens them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hw/stream/image_stream.h"

namespace flytri::stream {

struct FoundCamera {
  std::string node;   ///< differs between all cameras of the driver, e.g. /dev/video0
  std::string label;  ///< in messages: its name, and what tells it from others
};

/// Thread-safe.
class CameraDriver {
 public:
  virtual ~CameraDriver() = default;
  CameraDriver(const CameraDriver&) = delete;
  CameraDriver& operator=(const CameraDriver&) = delete;

  /// All cameras, including those that cannot be used.
  [[nodiscard]] virtual std::vector<device::CameraDescription> list() = 0;

  /// @errors  kNotFound, with the available cameras; kInconsistent: several cameras match
  [[nodiscard]] virtual Result<FoundCamera> find(const device::CameraMatch& match) = 0;

  /// Problems that would keep the camera from running with these settings, as far as they can be
  /// found without starting it.
  [[nodiscard]] virtual std::vector<Error> check(const device::CameraMatch& match,
                                                 const device::CameraSettings& settings) = 0;

  /// Finds the camera, sets it up and starts its stream.
  /// @param buffers  frames that the driver keeps while the reader is busy
  /// @errors  As device::Camera::start.
  [[nodiscard]] virtual Result<std::unique_ptr<ImageStream>> open(
      const device::CameraMatch& match, const device::CameraSettings& settings, int buffers) = 0;

 protected:
  CameraDriver() = default;
};

}  // namespace flytri::stream
