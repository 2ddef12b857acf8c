/// @file  The stream of one camera opened through Aravis.
#pragma once

#include <atomic>
#include <memory>

#include "hw/genicam/aravis.h"
#include "hw/genicam/find_camera.h"
#include "hw/stream/image_stream.h"

namespace flytri::genicam {

class GenicamStream final : public stream::ImageStream {
 public:
  /// Opens the camera, sets it up and starts its images.
  /// @errors  As device::Camera::start.
  [[nodiscard]] static Result<std::unique_ptr<GenicamStream>> open(
      const SeenCamera& camera, const device::CameraSettings& settings, int buffers);
  ~GenicamStream() override;

  [[nodiscard]] tl::expected<std::optional<stream::StreamedImage>, stream::StreamEnd> take(
      double timeout_s) override;
  [[nodiscard]] const device::CameraSettings& read_back() const override { return read_back_; }
  void expect_bits(int bits) override;
  [[nodiscard]] std::string name() const override { return seen_.name; }
  [[nodiscard]] std::string label() const override { return label_of(seen_); }

 private:
  explicit GenicamStream(SeenCamera seen) : seen_(std::move(seen)) {}
  [[nodiscard]] Result<void> begin(int buffers);
  [[nodiscard]] stream::StreamedImage read(ArvBuffer& buffer);

  const SeenCamera seen_;
  Owned<ArvCamera> camera_;
  Owned<ArvStream> stream_;  // released before the camera
  device::CameraSettings read_back_;
  stream::BufferLayout layout_;
  bool learns_bits_ = false;
  std::optional<std::uint64_t> first_frame_;
  std::atomic<bool> is_gone_ = false;  // set by a thread of Aravis
};

}  // namespace flytri::genicam
