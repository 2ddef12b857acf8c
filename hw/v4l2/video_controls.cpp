#include "hw/v4l2/video_controls.h"

#include <linux/videodev2.h>

#include <array>
#include <cmath>

#include "hw/v4l2/image_controls.h"
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

// Some cameras have no fully manual mode; with shutter priority, the exposure time is manual.
Result<void> expose_by_hand(const OpenVideo& video, WriteMode mode) {
  const auto info = query_control(video.device, V4L2_CID_EXPOSURE_AUTO);
  if (!info || !is_settable(*info)) return {};
  auto manual = write_control(video, *info, V4L2_EXPOSURE_MANUAL, mode);
  if (manual || manual.error().code == ErrorCode::kNotFound) return manual;
  return write_control(video, *info, V4L2_EXPOSURE_SHUTTER_PRIORITY, mode);
}

Result<void> turn_automatics_off(const OpenVideo& video, WriteMode mode) {
  if (auto done = expose_by_hand(video, mode); !done) return done;
  for (const std::uint32_t id : kAutomatic) {
    const auto info = query_control(video.device, id);
    if (!info || !is_settable(*info)) continue;
    if (auto done = write_control(video, *info, 0, mode); !done) return done;
  }
  return {};
}

Result<void> set_by_hand(const OpenVideo& video, const ManualControl& control, double wanted,
                         WriteMode mode) {
  const auto info = query_control(video.device, control.id);
  if (!info || !is_settable(*info))
    return fail(ErrorCode::kBadOption, "camera {} has no control {}: remove it from the settings",
                to_string(video.node), control.name);
  const double steps = std::round(wanted / control.unit);
  if (!(steps >= info->minimum && steps <= info->maximum))
    return fail(ErrorCode::kBadOption, "camera {}: {} is {}, but must be in {} to {}",
                to_string(video.node), control.name, wanted, info->minimum * control.unit,
                info->maximum * control.unit);
  return write_control(video, *info, static_cast<std::int32_t>(steps), mode);
}

}  // namespace

std::vector<device::CameraControl> list_controls(VideoDevice& device) {
  std::vector<device::CameraControl> controls;
  for (const v4l2_queryctrl& info : query_controls(device)) {
    const auto value = read_control(device, info.id);
    if (!value) continue;
    controls.push_back(
        {name_of(info), 1.0 * info.minimum, 1.0 * info.maximum, 1.0 * info.step, 1.0 * *value});
  }
  return controls;
}

Result<device::CameraSettings> set_controls(const OpenVideo& video,
                                            const device::CameraSettings& settings,
                                            WriteMode mode) {
  if (const auto done = turn_automatics_off(video, mode); !done)
    return tl::unexpected(done.error());
  device::CameraSettings read_back = settings;
  for (const ManualControl& control : kManualControls) {
    if (const auto wanted = settings.*control.field) {
      const auto done = set_by_hand(video, control, *wanted, mode);
      if (!done) return tl::unexpected(done.error());
    }
    const auto steps = query_control(video.device, control.id)
                           ? read_control(video.device, control.id)
                           : std::nullopt;
    read_back.*control.field = steps ? std::optional(*steps * control.unit) : std::nullopt;
  }
  auto image = set_image_controls(video, settings.controls, mode);
  if (!image) return tl::unexpected(image.error());
  read_back.controls = *std::move(image);
  return read_back;
}

}  // namespace flytri::v4l2
