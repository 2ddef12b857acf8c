#include "hw/gpio/open_chip.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iterator>

namespace flytri::gpio {

namespace {

/// The kernel ends the text with a zero unless it fills the array.
template <std::size_t kSize>
std::string kernel_text(const char (&text)[kSize]) {
  return {text, strnlen(text, kSize)};
}

}  // namespace

OpenChip::~OpenChip() { close(descriptor_); }

std::vector<GpioLine> OpenChip::lines() const {
  std::vector<GpioLine> lines(line_count_);
  for (unsigned i = 0; i < line_count_; ++i) {
    gpio_v2_line_info info{};
    info.offset = i;
    if (ioctl(descriptor_, GPIO_V2_GET_LINEINFO_IOCTL, &info) != 0) continue;
    lines[i] = {kernel_text(info.name), kernel_text(info.consumer)};
    const bool is_used = (info.flags & GPIO_V2_LINE_FLAG_USED) != 0;
    if (lines[i].consumer.empty() && is_used) lines[i].consumer = "the kernel";
  }
  return lines;
}

std::unique_ptr<HeldLines> OpenChip::hold(const std::vector<unsigned>& lines,
                                          const std::vector<int>& values) {
  gpio_v2_line_request request = output_request(lines, values, "flytri");
  if (ioctl(descriptor_, GPIO_V2_GET_LINE_IOCTL, &request) != 0) return nullptr;
  return std::make_unique<HeldLines>(request.fd);
}

std::unique_ptr<OpenChip> open_chip(const std::string& node) {
  const int descriptor = open(node.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  gpiochip_info info{};
  if (ioctl(descriptor, GPIO_GET_CHIPINFO_IOCTL, &info) == 0)
    return std::make_unique<OpenChip>(descriptor, kernel_text(info.label), info.lines);
  const int error = errno;
  close(descriptor);
  errno = error;
  return nullptr;
}

}  // namespace flytri::gpio
