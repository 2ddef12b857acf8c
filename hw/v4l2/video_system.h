/// @file  Interface to the system calls for cameras, which tests replace.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hw/device/device_node.h"

namespace flytri::v4l2 {

/// An open device file. The destructor closes it and unmaps its buffers.
class VideoDevice {
 public:
  virtual ~VideoDevice() = default;
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;

  /// Calls ioctl, and repeats it if a signal interrupted it.
  /// @return  0, or the errno
  [[nodiscard]] virtual int control(unsigned long request, void* argument) = 0;

  /// Maps a buffer of the driver for reading, valid while the device is open; empty on failure.
  [[nodiscard]] virtual std::span<const std::uint8_t> map(std::size_t length,
                                                          std::int64_t offset) = 0;

  /// Waits for a filled buffer or an error.
  /// @return  false on timeout
  [[nodiscard]] virtual bool wait(double timeout_s) = 0;

 protected:
  VideoDevice() = default;
};

class VideoSystem {
 public:
  virtual ~VideoSystem() = default;
  VideoSystem(const VideoSystem&) = delete;
  VideoSystem& operator=(const VideoSystem&) = delete;

  /// The present device files, as from list_device_nodes(). A camera may have several: index 0
  /// delivers images, others deliver metadata.
  [[nodiscard]] virtual std::vector<device::DeviceNode> nodes() = 0;

  /// @return  the device, or the errno
  [[nodiscard]] virtual tl::expected<std::unique_ptr<VideoDevice>, int> open(
      const std::string& node) = 0;

 protected:
  VideoSystem() = default;
};

/// The real system: V4L2 and udev.
[[nodiscard]] std::shared_ptr<VideoSystem> kernel_video_system();

}  // namespace flytri::v4l2
