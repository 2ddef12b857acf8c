/// @file  The stream of one opened camera.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hw/device/camera.h"
#include "hw/v4l2/pixel_conversion.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

/// A converted buffer with the driver's own numbers.
struct StreamedImage {
  ConvertedImage converted;
  bool flagged = false;        ///< marked as damaged by the driver
  std::uint32_t sequence = 0;  ///< by the driver; 0 at the start of the stream, wraps around
  /// By the driver, on the monotonic clock; nothing if the driver uses another clock.
  std::optional<double> time_s;
  device::StampMeaning stamp = device::StampMeaning::kStartOfExposure;
};

/// Why a stream ended.
struct StreamEnd {
  bool gone = false;  ///< the device is unplugged
  Error error;
};

class VideoStream {
 public:
  /// Sets mode and controls, maps the buffers, starts the stream and sets the controls again.
  /// @errors  As Camera::start.
  [[nodiscard]] static Result<std::unique_ptr<VideoStream>> open(
      VideoSystem& system, const device::DeviceNode& node, const device::CameraSettings& settings,
      int buffers);
  ~VideoStream();
  VideoStream(const VideoStream&) = delete;
  VideoStream& operator=(const VideoStream&) = delete;

  /// The next image; nothing if none arrived in time. After an error, the stream cannot be used any
  /// more.
  [[nodiscard]] tl::expected<std::optional<StreamedImage>, StreamEnd> take(double timeout_s);

  [[nodiscard]] const device::CameraSettings& read_back() const { return read_back_; }
  /// Call it with what an earlier stream of the camera learned: a restart must not change the
  /// brightness. Does nothing if the settings name the bits.
  void expect_bits(int bits);

 private:
  VideoStream(std::unique_ptr<VideoDevice> device, device::DeviceNode node);
  [[nodiscard]] Result<void> set_up(const device::CameraSettings& settings);
  [[nodiscard]] Result<void> begin(int buffers);
  [[nodiscard]] Result<void> set_controls_again(const device::CameraSettings& settings);
  [[nodiscard]] StreamEnd ended(std::string_view doing, int error_number) const;

  std::unique_ptr<VideoDevice> device_;
  const device::DeviceNode node_;
  device::CameraSettings read_back_;
  BufferLayout layout_;
  bool learns_bits_ = false;
  std::vector<std::span<const std::uint8_t>> buffers_;
  bool streaming_ = false;
};

}  // namespace flytri::v4l2
