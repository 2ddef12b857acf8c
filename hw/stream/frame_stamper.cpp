#include "hw/stream/frame_stamper.h"

#include <algorithm>

namespace flytri::stream {

void FrameStamper::begin_stream(double period_s) {
  first_of_stream_ = true;
  period_s_ = period_s;
}

std::int64_t FrameStamper::next_sequence(std::uint32_t driver_sequence,
                                         device::CameraStatus& status) {
  std::int64_t step = 2;
  if (!first_of_stream_) {
    // Unsigned arithmetic is also right when the number wraps around to 0.
    const std::uint32_t counted = driver_sequence - driver_sequence_;
    // If a driver does not count, or counts backwards, gaps are unknown.
    constexpr std::uint32_t kBackwards = 1u << 31;
    step = counted == 0 || counted >= kBackwards ? 1 : counted;
    status.dropped += step - 1;
  } else if (driver_sequence < 1000) {
    // Frames dropped before the first one arrived; a larger number cannot be such a count.
    step += driver_sequence;
    status.dropped += driver_sequence;
  }
  first_of_stream_ = false;
  driver_sequence_ = driver_sequence;
  return sequence_ + step;
}

double FrameStamper::next_time_s(const StreamedImage& image, double arrival_s,
                                 device::CameraStatus& status) {
  // Some drivers give the planned end of the exposure, up to one period in the future.
  const double latest_s = arrival_s + period_s_;
  if (image.time_s && *image.time_s > time_s_ && *image.time_s <= latest_s) return *image.time_s;
  ++status.restamped;
  // Resolution of the stamps; needed if two frames arrive at the same time.
  constexpr double kLeastStep = 1e-6;
  return std::max(arrival_s, time_s_ + kLeastStep);
}

device::CameraFrame FrameStamper::enter(const StreamedImage& image, double arrival_s,
                                        device::CameraStatus& status) {
  device::CameraFrame frame;
  frame.image = image.converted.image;
  frame.stamp = image.stamp;
  frame.sequence = sequence_ = next_sequence(image.sequence, status);
  frame.time_s = time_s_ = next_time_s(image, arrival_s, status);
  frame.damaged = image.flagged || image.converted.outcome != Conversion::kDone;
  status.flagged += image.flagged ? 1 : 0;
  status.short_frames += image.converted.outcome == Conversion::kShort ? 1 : 0;
  status.undecodable += image.converted.outcome == Conversion::kUndecodable ? 1 : 0;
  ++status.delivered;
  return frame;
}

}  // namespace flytri::stream
