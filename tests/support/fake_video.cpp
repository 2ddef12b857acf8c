#include "tests/support/fake_video.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

namespace flytri::testing {

namespace {

constexpr std::size_t kBufferBytes = 65536;

class FakeVideoDevice final : public v4l2::VideoDevice {
 public:
  FakeVideoDevice(std::shared_ptr<FakeCamera> camera, device::Clock clock)
      : camera_(std::move(camera)), clock_(std::move(clock)) {
    ++camera_->opened;
  }
  ~FakeVideoDevice() override { stop(); }

  int control(unsigned long request, void* argument) override {
    if (!camera_->present) return ENODEV;
    if (const auto found = camera_->errors.find(request); found != camera_->errors.end())
      return found->second;
    const int done = describe(request, argument);
    return done == ENOTTY ? stream(request, argument) : done;
  }

  std::span<const std::uint8_t> map(std::size_t length, std::int64_t offset) override {
    return std::span<const std::uint8_t>(memory_.at(offset)).first(length);
  }

  bool wait(double timeout_s) override {
    if (!camera_->present || !camera_->frames.empty()) return true;
    clock_.sleep_s(timeout_s);
    return false;
  }

 private:
  int describe(unsigned long request, void* argument) {
    switch (request) {
      case VIDIOC_QUERYCAP:
        static_cast<v4l2_capability*>(argument)->device_caps =
            V4L2_CAP_STREAMING |
            (camera_->captures ? V4L2_CAP_VIDEO_CAPTURE : V4L2_CAP_META_CAPTURE);
        return 0;
      case VIDIOC_ENUM_FMT:
        return list_format(*static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_ENUM_FRAMESIZES:
        return list_size(*static_cast<v4l2_frmsizeenum*>(argument));
      case VIDIOC_TRY_FMT:
      case VIDIOC_S_FMT:
        return set_format(static_cast<v4l2_format*>(argument)->fmt.pix);
      case VIDIOC_QUERYCTRL:
        return query(*static_cast<v4l2_queryctrl*>(argument));
      case VIDIOC_G_CTRL:
      case VIDIOC_S_CTRL:
        return exchange(*static_cast<v4l2_control*>(argument), request == VIDIOC_S_CTRL);
      default:
        return ENOTTY;
    }
  }

  int stream(unsigned long request, void* argument) {
    switch (request) {
      case VIDIOC_REQBUFS:
        memory_.assign(static_cast<v4l2_requestbuffers*>(argument)->count,
                       std::vector<std::uint8_t>(kBufferBytes));
        return 0;
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = kBufferBytes;
        buffer.m.offset = buffer.index;
        return 0;
      }
      case VIDIOC_QBUF:
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        return dequeue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        camera_->streaming += std::exchange(streaming_, true) ? 0 : 1;
        for (const auto& [id, value] : camera_->reset_at_start) camera_->controls[id].value = value;
        return 0;
      case VIDIOC_STREAMOFF:
        stop();
        return 0;
      default:
        return ENOTTY;
    }
  }

  void stop() { camera_->streaming -= std::exchange(streaming_, false) ? 1 : 0; }

  int list_format(v4l2_fmtdesc& entry) const {
    if (entry.index > 0) return EINVAL;
    entry.pixelformat = camera_->fourcc;
    return 0;
  }

  int list_size(v4l2_frmsizeenum& entry) const {
    if (entry.index > 0) return EINVAL;
    entry.type = V4L2_FRMSIZE_TYPE_DISCRETE;
    entry.discrete = {camera_->width, camera_->height};
    return 0;
  }

  int set_format(v4l2_pix_format& pixels) const {
    pixels.pixelformat = camera_->fourcc;
    pixels.width = camera_->width;
    pixels.height = camera_->height;
    return 0;
  }

  int query(v4l2_queryctrl& info) const {
    const bool next = (info.id & V4L2_CTRL_FLAG_NEXT_CTRL) != 0;
    const std::uint32_t id = info.id & ~V4L2_CTRL_FLAG_NEXT_CTRL;
    const auto found = next ? camera_->controls.upper_bound(id) : camera_->controls.find(id);
    if (found == camera_->controls.end()) return EINVAL;
    info.id = found->first;
    info.type = V4L2_CTRL_TYPE_INTEGER;
    info.minimum = found->second.minimum;
    info.maximum = found->second.maximum;
    info.step = 1;
    info.default_value = found->second.neutral;
    found->second.name.copy(reinterpret_cast<char*>(info.name), sizeof info.name - 1);
    return 0;
  }

  int exchange(v4l2_control& control, bool set) {
    const auto found = camera_->controls.find(control.id);
    if (found == camera_->controls.end()) return EINVAL;
    (set ? found->second.value : control.value) = set ? control.value : found->second.value;
    return 0;
  }

  int dequeue(v4l2_buffer& buffer) {
    if (camera_->frames.empty() || queued_.empty()) return EAGAIN;
    const FakeBuffer frame = std::move(camera_->frames.front());
    camera_->frames.pop_front();
    if (frame.error != 0) return frame.error;
    buffer.index = queued_.front();
    queued_.pop_front();
    std::copy(frame.bytes.begin(), frame.bytes.end(), memory_.at(buffer.index).begin());
    buffer.bytesused = static_cast<std::uint32_t>(frame.bytes.size());
    buffer.sequence = frame.sequence;
    buffer.flags = frame.flags | (frame.monotonic ? V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC : 0);
    buffer.timestamp.tv_sec = static_cast<std::int64_t>(frame.time_s);
    buffer.timestamp.tv_usec = std::lround((frame.time_s - std::floor(frame.time_s)) * 1e6);
    return 0;
  }

  std::shared_ptr<FakeCamera> camera_;
  device::Clock clock_;
  std::vector<std::vector<std::uint8_t>> memory_;
  std::deque<std::uint32_t> queued_;
  bool streaming_ = false;
};

}  // namespace

std::shared_ptr<FakeCamera> FakeVideoSystem::add() {
  cameras_.push_back(std::make_shared<FakeCamera>());
  return cameras_.back();
}

std::vector<device::DeviceNode> FakeVideoSystem::nodes() {
  std::vector<device::DeviceNode> nodes;
  for (const auto& camera : cameras_)
    if (camera->present) nodes.push_back(camera->node);
  return nodes;
}

tl::expected<std::unique_ptr<v4l2::VideoDevice>, int> FakeVideoSystem::open(
    const std::string& node) {
  for (const auto& camera : cameras_) {
    if (camera->node.node != node || !camera->present) continue;
    if (camera->open_error != 0) return tl::unexpected(camera->open_error);
    return std::make_unique<FakeVideoDevice>(camera, clock_);
  }
  return tl::unexpected(ENOENT);
}

}  // namespace flytri::testing
