#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "hw/v4l2/video_system.h"

namespace flytri::v4l2 {

namespace {

class KernelVideoDevice final : public VideoDevice {
 public:
  explicit KernelVideoDevice(int descriptor) : descriptor_(descriptor) {}
  ~KernelVideoDevice() override {
    for (const auto& [address, length] : mapped_) munmap(address, length);
    close(descriptor_);
  }

  int control(unsigned long request, void* argument) override {
    int status = 0;
    do {
      status = ioctl(descriptor_, request, argument);
    } while (status < 0 && errno == EINTR);
    return status < 0 ? errno : 0;
  }

  std::span<const std::uint8_t> map(std::size_t length, std::int64_t offset) override {
    void* address = mmap(nullptr, length, PROT_READ, MAP_SHARED, descriptor_, offset);
    if (address == MAP_FAILED) return {};
    mapped_.emplace_back(address, length);
    return {static_cast<const std::uint8_t*>(address), length};
  }

  // A signal may end the wait early; the caller sees no frame.
  bool wait(double timeout_s) override {
    pollfd waiting{descriptor_, POLLIN, 0};
    const double timeout_ms = std::ceil(std::clamp(timeout_s, 0.0, 3600.0) * 1000.0);
    return poll(&waiting, 1, static_cast<int>(timeout_ms)) > 0;
  }

 private:
  int descriptor_;
  std::vector<std::pair<void*, std::size_t>> mapped_;
};

class KernelVideoSystem final : public VideoSystem {
 public:
  std::vector<device::DeviceNode> nodes() override {
    return device::list_device_nodes("video4linux");
  }

  tl::expected<std::unique_ptr<VideoDevice>, int> open(const std::string& node) override {
    const int descriptor = ::open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return tl::unexpected(errno);
    return std::make_unique<KernelVideoDevice>(descriptor);
  }
};

}  // namespace

std::shared_ptr<VideoSystem> kernel_video_system() { return std::make_shared<KernelVideoSystem>(); }

}  // namespace flytri::v4l2
