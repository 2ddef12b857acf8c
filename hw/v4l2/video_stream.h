/// @file  The stream of one camera opened through V4L2.
#pragma once

#include <memory>
#include <vector>

#include "hw/stream/image_stream.h"
#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

class VideoStream final : public stream::ImageStream {
 public:
  /// Sets mode and controls, maps the buffers, starts the stream and sets the controls again.
  /// @errors  As Camera::start.
  [[nodiscard]] static Result<std::unique_ptr<VideoStream>> open(
      VideoSystem& system, const device::DeviceNode& node, const device::CameraSettings& settings,
      int buffers);
  ~VideoStream() override;

  [[nodiscard]] tl::expected<std::optional<stream::StreamedImage>, stream::StreamEnd> take(
      double timeout_s) override;
  [[nodiscard]] const device::CameraSettings& read_back() const override { return read_back_; }
  void expect_bits(int bits) override;
  [[nodiscard]] std::string name() const override { return node_.name; }
  [[nodiscard]] std::string label() const override;

 private:
  VideoStream(std::unique_ptr<VideoDevice> device, device::DeviceNode node);
  [[nodiscard]] Result<void> set_up(const device::CameraSettings& settings);
  [[nodiscard]] Result<void> begin(int buffers);
  [[nodiscard]] Result<void> set_controls_again(const device::CameraSettings& settings);
  [[nodiscard]] stream::StreamEnd ended(std::string_view doing, int error_number) const;

  std::unique_ptr<VideoDevice> device_;
  const device::DeviceNode node_;
  device::CameraSettings read_back_;
  stream::BufferLayout layout_;
  bool learns_bits_ = false;
  std::vector<std::span<const std::uint8_t>> buffers_;
  bool streaming_ = false;
};

}  // namespace flytri::v4l2
