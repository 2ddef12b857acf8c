/// @file  Fake V4L2 cameras that answer system calls like real drivers.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hw/device/clock.h"
#include "hw/v4l2/video_system.h"

namespace flytri::testing {

struct FakeControl {
  std::int32_t minimum = 0;
  std::int32_t maximum = 1;
  std::int32_t value = 0;
  std::int32_t neutral = 0;  ///< the default in the driver's description
  std::string name = {};
};

struct FakeBuffer {
  std::vector<std::uint8_t> bytes;
  std::uint32_t sequence = 0;
  double time_s = 0.0;
  std::uint32_t flags = 0;  ///< in addition to the clock's flag
  bool monotonic = true;
  int error = 0;  ///< error of VIDIOC_DQBUF instead of a frame
};

/// A camera with one format and size. All members may be changed while it runs.
struct FakeCamera {
  device::DeviceNode node{"/dev/video0", "Fake Camera", "F1", "1-1", 0};
  std::uint32_t fourcc = 0;
  std::uint32_t width = 4;
  std::uint32_t height = 2;
  std::map<std::uint32_t, FakeControl> controls;
  std::deque<FakeBuffer> frames;        ///< frames to deliver; none if empty
  std::map<unsigned long, int> errors;  ///< errno by request, for calls that shall fail
  int open_error = 0;
  std::map<std::uint32_t, std::int32_t> reset_at_start;  ///< values that it takes with STREAMON
  bool captures = true;
  bool present = true;
  int opened = 0;     ///< how often it was opened
  int streaming = 0;  ///< number of running streams
};

/// A system with fake cameras.
class FakeVideoSystem final : public v4l2::VideoSystem {
 public:
  explicit FakeVideoSystem(device::Clock clock) : clock_(std::move(clock)) {}
  std::shared_ptr<FakeCamera> add();
  std::vector<device::DeviceNode> nodes() override;
  tl::expected<std::unique_ptr<v4l2::VideoDevice>, int> open(const std::string& node) override;

 private:
  device::Clock clock_;
  std::vector<std::shared_ptr<FakeCamera>> cameras_;
};

}  // namespace flytri::testing
