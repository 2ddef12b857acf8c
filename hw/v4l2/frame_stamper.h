/// @file  Makes frames of streamed images: running numbers, times that rise, counts of what is
/// wrong.
#pragma once

#include "hw/device/camera.h"
#include "hw/v4l2/video_stream.h"

namespace flytri::v4l2 {

class FrameStamper {
 public:
  /// The driver counts from 0 again; what was missed in between is one gap.
  /// @param period_s  > 0, of frames
  void begin_stream(double period_s);

  /// @param arrival_s  when the image was taken from the driver; not before the call before
  /// @param status  what is wrong with it is counted here
  [[nodiscard]] device::CameraFrame enter(const StreamedImage& image, double arrival_s,
                                          device::CameraStatus& status);

 private:
  [[nodiscard]] std::int64_t next_sequence(std::uint32_t driver_sequence,
                                           device::CameraStatus& status);
  [[nodiscard]] double next_time_s(const StreamedImage& image, double arrival_s,
                                   device::CameraStatus& status);

  std::int64_t sequence_ = -2;  // the last one's; so that the first one is 0
  double time_s_ = 0.0;         // the last one's
  double period_s_ = 0.0;
  bool first_of_stream_ = true;
  std::uint32_t driver_sequence_ = 0;
};

}  // namespace flytri::v4l2
