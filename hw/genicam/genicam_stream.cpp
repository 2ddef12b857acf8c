#include "hw/genicam/genicam_stream.h"

#include <algorithm>
#include <chrono>

#include "hw/genicam/camera_features.h"

namespace flytri::genicam {
namespace {

constexpr double kNanoseconds = 1e9;

/// Aravis stamps images with the time of day; ours is monotonic.
std::optional<double> monotonic_s(std::uint64_t of_day_ns) {
  if (of_day_ns == 0) return std::nullopt;
  const auto seconds = [](auto clock_time) {
    return std::chrono::duration<double>(clock_time.time_since_epoch()).count();
  };
  const double ago_s =
      seconds(std::chrono::system_clock::now()) - static_cast<double>(of_day_ns) / kNanoseconds;
  return seconds(std::chrono::steady_clock::now()) - ago_s;
}

void camera_gone(ArvDevice* /*device*/, std::atomic<bool>* is_gone) { *is_gone = true; }

}  // namespace

Result<std::unique_ptr<GenicamStream>> GenicamStream::open(const SeenCamera& camera,
                                                           const device::CameraSettings& settings,
                                                           int buffers) {
  std::unique_ptr<GenicamStream> stream(new GenicamStream(camera));
  ArvFailure failure;
  stream->camera_.reset(arv_camera_new(camera.id.c_str(), failure.out()));
  if (!stream->camera_) return tl::unexpected(failure.told(label_of(camera), "opening it"));
  const std::string label = stream->label();
  const auto agreed = set_up({*stream->camera_, label}, settings);
  if (!agreed) return tl::unexpected(agreed.error());
  stream->read_back_ = *agreed;
  stream->learns_bits_ = settings.format == device::PixelFormat::kGrey16 && !settings.bits;
  stream->layout_ = {settings.format, settings.size, 0,
                     stream->learns_bits_ ? 0 : settings.bits.value_or(16)};
  stream->layout_.bytes_per_line =
      stream::bytes_needed({settings.format, {settings.size.width_px, 1}, 0, 16});
  if (auto begun = stream->begin(buffers); !begun) return tl::unexpected(begun.error());
  return stream;
}

Result<void> GenicamStream::begin(int buffers) {
  ArvFailure failure;
  g_signal_connect(arv_camera_get_device(camera_.get()), "control-lost", G_CALLBACK(camera_gone),
                   &is_gone_);
  const guint payload = arv_camera_get_payload(camera_.get(), failure.out());
  if (failure) return tl::unexpected(failure.told(label(), "asking for the size of its images"));
  stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, failure.out()));
  if (!stream_) return tl::unexpected(failure.told(label(), "making a stream"));
  for (int i = 0; i < buffers; ++i)
    arv_stream_push_buffer(stream_.get(), arv_buffer_new_allocate(payload));
  arv_camera_start_acquisition(camera_.get(), failure.out());
  if (failure) return tl::unexpected(failure.told(label(), "starting the stream"));
  return {};
}

GenicamStream::~GenicamStream() {
  if (!camera_) return;
  g_signal_handlers_disconnect_by_data(arv_camera_get_device(camera_.get()), &is_gone_);
  // Fails if the camera is unplugged; nothing else is to be done then.
  ArvFailure ignored;
  if (stream_) arv_camera_stop_acquisition(camera_.get(), ignored.out());
}

void GenicamStream::expect_bits(int bits) {
  if (!learns_bits_) return;
  layout_.bits = std::max(layout_.bits, bits);
  read_back_.bits = layout_.bits;
}

stream::StreamedImage GenicamStream::read(ArvBuffer& buffer) {
  stream::StreamedImage image;
  std::size_t size = 0;
  const auto* const data =
      static_cast<const std::uint8_t*>(arv_buffer_get_image_data(&buffer, &size));
  image.flagged = arv_buffer_get_status(&buffer) != ARV_BUFFER_STATUS_SUCCESS;
  const std::span<const std::uint8_t> bytes(data, data == nullptr ? 0 : size);
  if (learns_bits_ && !image.flagged) expect_bits(stream::bits_used(bytes, layout_));
  image.converted = stream::convert(bytes, layout_, read_back_.channels);
  // The first number differs between cameras. GigE Vision counts to 65535 and goes on at 1.
  const std::uint64_t frame = arv_buffer_get_frame_id(&buffer);
  if (!first_frame_) first_frame_ = frame;
  image.sequence = static_cast<std::uint32_t>(frame - *first_frame_);
  image.time_s = monotonic_s(arv_buffer_get_system_timestamp(&buffer));
  image.stamp = device::StampMeaning::kEndOfReadout;
  return image;
}

tl::expected<std::optional<stream::StreamedImage>, stream::StreamEnd> GenicamStream::take(
    double timeout_s) {
  if (is_gone_)
    return tl::unexpected(stream::StreamEnd{
        true,
        {ErrorCode::kNotFound, fmt::format("camera {} was unplugged: plug it in again", label())}});
  const auto microseconds = static_cast<guint64>(std::max(0.0, timeout_s) * 1e6);
  ArvBuffer* const buffer = arv_stream_timeout_pop_buffer(stream_.get(), microseconds);
  if (buffer == nullptr) return std::nullopt;
  const ArvBufferStatus status = arv_buffer_get_status(buffer);
  std::optional<stream::StreamedImage> image;
  // Buffers that were never filled hold no image.
  if (status != ARV_BUFFER_STATUS_CLEARED && status != ARV_BUFFER_STATUS_ABORTED &&
      status != ARV_BUFFER_STATUS_UNKNOWN)
    image = read(*buffer);
  arv_stream_push_buffer(stream_.get(), buffer);
  return image;
}

}  // namespace flytri::genicam
