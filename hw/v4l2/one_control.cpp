#include "hw/v4l2/one_control.h"

#include <cerrno>
#include <cstring>

#include "hw/v4l2/video_failure.h"

namespace flytri::v4l2 {

std::optional<v4l2_queryctrl> query_control(VideoDevice& device, std::uint32_t id) {
  v4l2_queryctrl info{};
  info.id = id;
  return device.control(VIDIOC_QUERYCTRL, &info) == 0 ? std::optional(info) : std::nullopt;
}

std::vector<v4l2_queryctrl> query_controls(VideoDevice& device) {
  std::vector<v4l2_queryctrl> controls;
  std::uint32_t last = 0;
  while (const auto info = query_control(device, last | V4L2_CTRL_FLAG_NEXT_CTRL)) {
    if (info->id <= last) break;  // guards against a driver that repeats its list
    last = info->id;
    const bool is_number = info->type == V4L2_CTRL_TYPE_INTEGER ||
                           info->type == V4L2_CTRL_TYPE_BOOLEAN ||
                           info->type == V4L2_CTRL_TYPE_MENU;
    if (is_number) controls.push_back(*info);
  }
  return controls;
}

std::optional<std::int32_t> read_control(VideoDevice& device, std::uint32_t id) {
  v4l2_control control{id, 0};
  if (device.control(VIDIOC_G_CTRL, &control) != 0) return std::nullopt;
  return control.value;
}

std::string name_of(const v4l2_queryctrl& info) {
  const auto* name = reinterpret_cast<const char*>(info.name);
  return {name, strnlen(name, sizeof info.name)};
}

bool is_settable(const v4l2_queryctrl& info) {
  return (info.flags & (V4L2_CTRL_FLAG_READ_ONLY | V4L2_CTRL_FLAG_DISABLED)) == 0;
}

Result<void> write_control(const OpenVideo& video, const v4l2_queryctrl& info, std::int32_t value,
                           WriteMode mode) {
  const bool is_set = read_control(video.device, info.id) == value;
  if (is_set && mode == WriteMode::kIfChanged) return {};
  v4l2_control control{info.id, value};
  const int error = video.device.control(VIDIOC_S_CTRL, &control);
  if (error == 0 || is_set) return {};
  // The camera is open, so EACCES does not mean missing permissions here.
  if (error == EACCES)
    return fail(ErrorCode::kBadOption,
                "camera {}: \"{}\" cannot be set to {}, because an automatic mode that cannot be "
                "turned off controls it: remove it from the settings",
                to_string(video.node), name_of(info), value);
  return tl::unexpected(
      video_failure(video.node, fmt::format("setting \"{}\" to {}", name_of(info), value), error));
}

}  // namespace flytri::v4l2
