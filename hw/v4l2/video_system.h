/// @file  The system calls that cameras need, so that tests can stand in for the kernel.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hw/device/device_node.h"

namespace flytri::v4l2 {

/// A device file that is open; it is closed, and what was mapped let go, on destruction.
class VideoDevice {
 public:
  virtual ~VideoDevice() = default;
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;

  /// ioctl, repeated where a signal interrupted it.
  /// @return  0, or the errno
  [[nodiscard]] virtual int control(unsigned long request, void* argument) = 0;

  /// A buffer of the driver's for reading, as long as the device is open; empty: it failed.
  [[nodiscard]] virtual std::span<const std::uint8_t> map(std::size_t length,
                                                          std::int64_t offset) = 0;

  /// Waits until a buffer is filled or something is wrong.
  /// @return  false: neither within the time
  [[nodiscard]] virtual bool wait(double timeout_s) = 0;

 protected:
  VideoDevice() = default;
};

class VideoSystem {
 public:
  virtual ~VideoSystem() = default;
  VideoSystem(const VideoSystem&) = delete;
  VideoSystem& operator=(const VideoSystem&) = delete;

  /// All that are there now, as list_device_nodes() gives them. A camera may have several: images,
  /// with the index 0, and what describes them.
  [[nodiscard]] virtual std::vector<device::DeviceNode> nodes() = 0;

  /// @return  or the errno
  [[nodiscard]] virtual tl::expected<std::unique_ptr<VideoDevice>, int> open(
      const std::string& node) = 0;

 protected:
  VideoSystem() = default;
};

/// The machine's own: V4L2 and udev.
[[nodiscard]] std::shared_ptr<VideoSystem> kernel_video_system();

}  // namespace flytri::v4l2
