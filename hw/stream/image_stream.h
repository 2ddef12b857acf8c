/// @file  Interface of the running stream of one opened camera, whatever drives it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hw/device/camera.h"
#include "hw/stream/pixel_conversion.h"

namespace flytri::stream {

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

class ImageStream {
 public:
  virtual ~ImageStream() = default;
  ImageStream(const ImageStream&) = delete;
  ImageStream& operator=(const ImageStream&) = delete;

  /// The next image; nothing if none arrived in time. After an error, the stream cannot be used any
  /// more.
  [[nodiscard]] virtual tl::expected<std::optional<StreamedImage>, StreamEnd> take(
      double timeout_s) = 0;

  /// Settings that the camera uses. Without a value: it lacks the control.
  [[nodiscard]] virtual const device::CameraSettings& read_back() const = 0;
  /// Call it with what an earlier stream of the camera learned: a restart must not change the
  /// brightness. Does nothing if the settings name the bits.
  virtual void expect_bits(int bits) { (void)bits; }
  /// Name of the camera, for lists.
  [[nodiscard]] virtual std::string name() const = 0;
  /// The camera in messages: its name, and what tells it from others.
  [[nodiscard]] virtual std::string label() const = 0;

 protected:
  ImageStream() = default;
};

}  // namespace flytri::stream
