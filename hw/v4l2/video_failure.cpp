#include "hw/v4l2/video_failure.h"

#include <cerrno>
#include <system_error>

namespace flytri::v4l2 {

namespace {

struct Cause {
  ErrorCode code;
  std::string_view text;
};

Cause cause_of(int error_number) {
  switch (error_number) {
    case EACCES:
    case EPERM:
      return {ErrorCode::kNotPermitted,
              "you have no permission to use it: add yourself to the group \"video\" and log in "
              "again, or install the udev rules of this program"};
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return {ErrorCode::kNotFound, "it was unplugged: plug it in again"};
    case EBUSY:
      return {ErrorCode::kInconsistent, "another program uses it: close that program"};
    case ENOSPC:
      return {ErrorCode::kBadOption,
              "the USB bus is too slow for these settings: use a smaller size, a lower rate or a "
              "compressed format, or connect the cameras to different USB controllers; if the "
              "camera asks for more than it needs, reload its driver with \"sudo modprobe -r "
              "uvcvideo; sudo modprobe uvcvideo quirks=0x80\""};
    case EINVAL:
    case ERANGE:
      return {ErrorCode::kBadOption,
              "it does not support this setting: \"flytri devices\" lists what it supports"};
    case ENOMEM:
      return {ErrorCode::kInconsistent, "there is too little memory: close other programs"};
    case EIO:
    case EPIPE:
    case EPROTO:
    case ETIMEDOUT:
      return {ErrorCode::kNotFound,
              "it does not answer: unplug it, then plug it in again with a short cable and without "
              "a hub"};
    default:
      return {ErrorCode::kNotFound, "unplug it and plug it in again"};
  }
}

}  // namespace

std::string to_string(const device::DeviceNode& node) {
  if (node.serial.empty()) return fmt::format("{} ({})", node.name, node.node);
  return fmt::format("{} (serial {}, {})", node.name, node.serial, node.node);
}

Error video_failure(const device::DeviceNode& node, std::string_view doing, int error_number) {
  const auto [code, text] = cause_of(error_number);
  return {code, fmt::format("camera {}: {} failed ({}): {}", to_string(node), doing,
                            std::generic_category().message(error_number), text)};
}

}  // namespace flytri::v4l2
