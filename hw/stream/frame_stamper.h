/// @file  Turns streamed images into frames with increasing numbers and times; counts faults.
#pragma once

#include "hw/device/camera.h"
#include "hw/stream/image_stream.h"

namespace flytri::stream {

class FrameStamper {
 public:
  /// Call when a stream starts: the driver counts from 0 again. Frames missed since the last stream
  /// count as one gap.
  /// @param period_s  > 0, frame period
  void begin_stream(double period_s);

  /// @param arrival_s  when the image was taken from the driver; never decreases
  /// @param status  its fault counts are updated
  [[nodiscard]] device::CameraFrame enter(const StreamedImage& image, double arrival_s,
                                          device::CameraStatus& status);

 private:
  [[nodiscard]] std::int64_t next_sequence(std::uint32_t driver_sequence,
                                           device::CameraStatus& status);
  [[nodiscard]] double next_time_s(const StreamedImage& image, double arrival_s,
                                   device::CameraStatus& status);

  std::int64_t sequence_ = -2;  // of the last frame; starts so that the first frame gets 0
  double time_s_ = 0.0;         // of the last frame
  double period_s_ = 0.0;
  bool first_of_stream_ = true;
  std::uint32_t driver_sequence_ = 0;
};

}  // namespace flytri::stream
