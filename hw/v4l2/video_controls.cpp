#include "hw/v4l2/video_controls.h"

#include <linux/videodev2.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "hw/v4l2/video_failure.h"

namespace flytri::v4l2 {

namespace {

// A control that the program sets, and the size of the camera's steps in our unit.
struct ManualControl {
  std::uint32_t id;
  std::string_view name;
  double unit;  // value in our unit = steps * unit
  std::optional<double> device::CameraSettings::*field;
};

constexpr std::array kManualControls = {
    ManualControl{V4L2_CID_EXPOSURE_ABSOLUTE, "exposure_s", 100e-6,
                  &device::CameraSettings::exposure_s},
    ManualControl{V4L2_CID_GAIN, "gain", 1.0, &device::CameraSettings::gain},
    ManualControl{V4L2_CID_WHITE_BALANCE_TEMPERATURE, "white_balance_k", 1.0,
                  &device::CameraSettings::white_balance_k},
    ManualControl{V4L2_CID_FOCUS_ABSOLUTE, "focus", 1.0, &device::CameraSettings::focus}};

// Automatic modes to turn off if the camera has them. The last one would lower the frame rate for a
// long exposure.
constexpr std::array<std::uint32_t, 6> kAutomatic = {
    V4L2_CID_AUTOGAIN, V4L2_CID_AUTO_WHITE_BALANCE, V4L2_CID_FOCUS_AUTO,
    V4L2_CID_HUE_AUTO, V4L2_CID_AUTOBRIGHTNESS,     V4L2_CID_EXPOSURE_AUTO_PRIORITY};

std::optional<v4l2_queryctrl> query(VideoDevice& device, std::uint32_t id) {
  v4l2_queryctrl info{};
  info.id = id;
  return device.control(VIDIOC_QUERYCTRL, &info) == 0 ? std::optional(info) : std::nullopt;
}

constexpr std::uint32_t kUnsettable = V4L2_CTRL_FLAG_READ_ONLY | V4L2_CTRL_FLAG_DISABLED;

std::optional<std::int32_t> read(VideoDevice& device, std::uint32_t id) {
  v4l2_control control{id, 0};
  if (device.control(VIDIOC_G_CTRL, &control) != 0) return std::nullopt;
  return control.value;
}

std::string text_of(const v4l2_queryctrl& info) {
  const auto* name = reinterpret_cast<const char*>(info.name);
  return {name, strnlen(name, sizeof info.name)};
}

Result<void> write(const OpenVideo& video, const v4l2_queryctrl& info, std::int32_t value) {
  // Some cameras refuse to set a value that is already set.
  if (read(video.device, info.id) == value) return {};
  v4l2_control control{info.id, value};
  const int error = video.device.control(VIDIOC_S_CTRL, &control);
  if (error == 0) return {};
  // The camera is open, so EACCES does not mean missing permissions here.
  if (error == EACCES)
    return fail(ErrorCode::kBadOption,
                "camera {}: \"{}\" cannot be set to {}, because an automatic mode that cannot be "
                "turned off controls it: remove it from the settings",
                to_string(video.node), text_of(info), value);
  return tl::unexpected(
      video_failure(video.node, fmt::format("setting \"{}\" to {}", text_of(info), value), error));
}

// Some cameras have no fully manual mode; with shutter priority, the exposure time is manual.
Result<void> expose_by_hand(const OpenVideo& video) {
  const auto info = query(video.device, V4L2_CID_EXPOSURE_AUTO);
  if (!info || (info->flags & kUnsettable)) return {};
  auto manual = write(video, *info, V4L2_EXPOSURE_MANUAL);
  if (manual || manual.error().code == ErrorCode::kNotFound) return manual;
  return write(video, *info, V4L2_EXPOSURE_SHUTTER_PRIORITY);
}

Result<void> turn_automatics_off(const OpenVideo& video) {
  if (auto done = expose_by_hand(video); !done) return done;
  for (const std::uint32_t id : kAutomatic) {
    const auto info = query(video.device, id);
    if (!info || (info->flags & kUnsettable)) continue;
    if (auto done = write(video, *info, 0); !done) return done;
  }
  return {};
}

Result<void> set_by_hand(const OpenVideo& video, const ManualControl& control, double wanted) {
  const auto info = query(video.device, control.id);
  if (!info || (info->flags & kUnsettable))
    return fail(ErrorCode::kBadOption, "camera {} has no control {}: remove it from the settings",
                to_string(video.node), control.name);
  const double steps = std::round(wanted / control.unit);
  if (!(steps >= info->minimum && steps <= info->maximum))
    return fail(ErrorCode::kBadOption, "camera {}: {} is {}, but must be in {} to {}",
                to_string(video.node), control.name, wanted, info->minimum * control.unit,
                info->maximum * control.unit);
  return write(video, *info, static_cast<std::int32_t>(steps));
}

}  // namespace

std::vector<device::CameraControl> list_controls(VideoDevice& device) {
  std::vector<device::CameraControl> controls;
  std::uint32_t last = 0;
  while (const auto info = query(device, last | V4L2_CTRL_FLAG_NEXT_CTRL)) {
    if (info->id <= last) break;  // guards against a driver that repeats its list
    last = info->id;
    const bool is_number = info->type == V4L2_CTRL_TYPE_INTEGER ||
                           info->type == V4L2_CTRL_TYPE_BOOLEAN ||
                           info->type == V4L2_CTRL_TYPE_MENU;
    const auto value = is_number ? read(device, info->id) : std::nullopt;
    if (!value) continue;
    controls.push_back(
        {text_of(*info), 1.0 * info->minimum, 1.0 * info->maximum, 1.0 * info->step, 1.0 * *value});
  }
  return controls;
}

Result<device::CameraSettings> set_controls(const OpenVideo& video,
                                            const device::CameraSettings& settings) {
  if (const auto done = turn_automatics_off(video); !done) return tl::unexpected(done.error());
  device::CameraSettings read_back = settings;
  for (const ManualControl& control : kManualControls) {
    if (const auto wanted = settings.*control.field) {
      const auto done = set_by_hand(video, control, *wanted);
      if (!done) return tl::unexpected(done.error());
    }
    const auto steps =
        query(video.device, control.id) ? read(video.device, control.id) : std::nullopt;
    read_back.*control.field = steps ? std::optional(*steps * control.unit) : std::nullopt;
  }
  return read_back;
}

}  // namespace flytri::v4l2
