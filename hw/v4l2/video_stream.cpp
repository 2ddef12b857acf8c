#include "hw/v4l2/video_stream.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>

#include "hw/v4l2/video_controls.h"
#include "hw/v4l2/video_failure.h"
#include "hw/v4l2/video_modes.h"

namespace flytri::v4l2 {

namespace {

v4l2_buffer empty_buffer() {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

// Reads the time stamp, and which moment it marks according to the driver.
void read_stamp(const v4l2_buffer& buffer, stream::StreamedImage& image) {
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)
    image.time_s = static_cast<double>(buffer.timestamp.tv_sec) +
                   1e-6 * static_cast<double>(buffer.timestamp.tv_usec);
  const bool at_start =
      (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  image.stamp =
      at_start ? device::StampMeaning::kStartOfExposure : device::StampMeaning::kEndOfReadout;
}

}  // namespace

VideoStream::VideoStream(std::unique_ptr<VideoDevice> device, device::DeviceNode node)
    : device_(std::move(device)), node_(std::move(node)) {}

VideoStream::~VideoStream() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  // Fails if the device is unplugged; nothing else is to be done then.
  if (streaming_) (void)device_->control(VIDIOC_STREAMOFF, &type);
}

Result<std::unique_ptr<VideoStream>> VideoStream::open(VideoSystem& system,
                                                       const device::DeviceNode& node,
                                                       const device::CameraSettings& settings,
                                                       int buffers) {
  auto device = system.open(node.node);
  if (!device) return tl::unexpected(video_failure(node, "opening it", device.error()));
  std::unique_ptr<VideoStream> stream(new VideoStream(std::move(*device), node));
  if (const auto done = stream->set_up(settings); !done) return tl::unexpected(done.error());
  if (const auto done = stream->begin(buffers); !done) return tl::unexpected(done.error());
  if (const auto done = stream->set_controls_again(settings); !done)
    return tl::unexpected(done.error());
  return stream;
}

Result<void> VideoStream::set_up(const device::CameraSettings& settings) {
  const OpenVideo video{*device_, node_};
  const auto mode = set_mode(video, settings);
  if (!mode) return tl::unexpected(mode.error());
  const auto controls = set_controls(video, settings);
  if (!controls) return tl::unexpected(controls.error());
  layout_ = mode->layout;
  learns_bits_ = settings.format == device::PixelFormat::kGrey16 && !settings.bits;
  if (learns_bits_) layout_.bits = 0;
  read_back_ = *controls;
  read_back_.rate_hz = mode->rate_hz;
  return {};
}

Result<void> VideoStream::begin(int buffers) {
  const auto failed = [&](std::string_view doing, int error) {
    return tl::unexpected(video_failure(node_, doing, error));
  };
  v4l2_requestbuffers request{};
  request.count = static_cast<std::uint32_t>(buffers);
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = device_->control(VIDIOC_REQBUFS, &request))
    return failed("asking for buffers", error);
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = empty_buffer();
    buffer.index = i;
    if (const int error = device_->control(VIDIOC_QUERYBUF, &buffer))
      return failed("querying a buffer", error);
    buffers_.push_back(device_->map(buffer.length, buffer.m.offset));
    if (buffers_.back().empty()) return failed("mapping a buffer", ENOMEM);
    if (const int error = device_->control(VIDIOC_QBUF, &buffer))
      return failed("queuing a buffer", error);
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = device_->control(VIDIOC_STREAMON, &type))
    return failed("starting the stream", error);
  streaming_ = true;
  return {};
}

// Some cameras reset their controls when the stream starts, and the driver does not know.
Result<void> VideoStream::set_controls_again(const device::CameraSettings& settings) {
  auto controls = set_controls({*device_, node_}, settings, WriteMode::kAlways);
  if (!controls) return tl::unexpected(controls.error());
  controls->rate_hz = read_back_.rate_hz;
  read_back_ = *std::move(controls);
  return {};
}

void VideoStream::expect_bits(int bits) {
  if (!learns_bits_) return;
  layout_.bits = std::max(layout_.bits, bits);
  read_back_.bits = layout_.bits;
}

std::string VideoStream::label() const { return to_string(node_); }

stream::StreamEnd VideoStream::ended(std::string_view doing, int error_number) const {
  return {error_number == ENODEV, video_failure(node_, doing, error_number)};
}

tl::expected<std::optional<stream::StreamedImage>, stream::StreamEnd> VideoStream::take(
    double timeout_s) {
  if (!device_->wait(timeout_s)) return std::nullopt;
  v4l2_buffer buffer = empty_buffer();
  const int error = device_->control(VIDIOC_DQBUF, &buffer);
  if (error == EAGAIN) return std::nullopt;
  if (error != 0) return tl::unexpected(ended("taking a frame", error));
  if (buffer.index >= buffers_.size()) return tl::unexpected(ended("taking a frame", EIO));
  const auto all = buffers_[buffer.index];
  const auto bytes = all.first(std::min<std::size_t>(all.size(), buffer.bytesused));
  if (learns_bits_) expect_bits(stream::bits_used(bytes, layout_));
  stream::StreamedImage image;
  image.converted = stream::convert(bytes, layout_, read_back_.channels);
  image.flagged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
  image.sequence = buffer.sequence;
  read_stamp(buffer, image);
  if (const int requeued = device_->control(VIDIOC_QBUF, &buffer))
    return tl::unexpected(ended("returning a buffer", requeued));
  return image;
}

}  // namespace flytri::v4l2
