#include "hw/v4l2/image_controls.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <vector>

#include "hw/v4l2/video_failure.h"

namespace flytri::v4l2 {

namespace {

enum class Neutral { kLinearGamma, kDefault, kSmallest };

struct ImageControl {
  std::uint32_t id;
  std::string_view name;  ///< in rig.json
  Neutral neutral;
};

constexpr std::array kImageControls = {
    ImageControl{V4L2_CID_GAMMA, "gamma", Neutral::kLinearGamma},
    ImageControl{V4L2_CID_CONTRAST, "contrast", Neutral::kDefault},
    ImageControl{V4L2_CID_SHARPNESS, "sharpness", Neutral::kSmallest},
    ImageControl{V4L2_CID_BACKLIGHT_COMPENSATION, "backlight_compensation", Neutral::kSmallest},
    ImageControl{V4L2_CID_POWER_LINE_FREQUENCY, "power_line_frequency", Neutral::kSmallest},
    ImageControl{V4L2_CID_WIDE_DYNAMIC_RANGE, "wide_dynamic_range", Neutral::kSmallest}};

/// A control of this camera.
struct FoundControl {
  v4l2_queryctrl info;
  std::string name;
  bool is_bending = true;  ///< gets a neutral value unless another one is asked for
  Neutral neutral = Neutral::kSmallest;
};

/// V4L2 has no control for noise filters; drivers have their own.
bool is_noise_filter(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return name.find("noise") != std::string::npos;
}

FoundControl found(const v4l2_queryctrl& info) {
  const auto known = std::find_if(kImageControls.begin(), kImageControls.end(),
                                  [&](const ImageControl& each) { return each.id == info.id; });
  if (known != kImageControls.end()) return {info, std::string(known->name), true, known->neutral};
  return {info, name_of(info), is_noise_filter(name_of(info)), Neutral::kSmallest};
}

std::vector<FoundControl> find_controls(VideoDevice& device) {
  std::vector<FoundControl> controls;
  for (const v4l2_queryctrl& info : query_controls(device)) {
    if (is_settable(info)) controls.push_back(found(info));
  }
  return controls;
}

std::int32_t neutral_value(const FoundControl& control) {
  constexpr std::int32_t kLinearGamma = 100;
  const v4l2_queryctrl& info = control.info;
  switch (control.neutral) {
    case Neutral::kLinearGamma:
      return info.minimum <= kLinearGamma && kLinearGamma <= info.maximum ? kLinearGamma
                                                                          : info.default_value;
    case Neutral::kDefault:
      return info.default_value;
    case Neutral::kSmallest:
      break;
  }
  return info.minimum;
}

Result<std::int32_t> wanted_value(const OpenVideo& video, const FoundControl& control,
                                  double wanted) {
  const double steps = std::round(wanted);
  if (steps >= control.info.minimum && steps <= control.info.maximum)
    return static_cast<std::int32_t>(steps);
  return fail(ErrorCode::kBadOption, "camera {}: {} is {}, but must be in {} to {}",
              to_string(video.node), control.name, wanted, control.info.minimum,
              control.info.maximum);
}

Result<void> check_names(const OpenVideo& video, const NamedControls& wanted,
                         const std::vector<FoundControl>& controls) {
  for (const auto& entry : wanted) {
    const std::string& name = entry.first;
    const bool is_there = std::any_of(controls.begin(), controls.end(),
                                      [&](const FoundControl& each) { return each.name == name; });
    if (is_there) continue;
    std::string names;
    for (const FoundControl& control : controls)
      names += (names.empty() ? "" : ", ") + control.name;
    return fail(ErrorCode::kBadOption,
                "camera {} has no control \"{}\": remove it from \"controls\" in rig.json, or use "
                "one of: {}",
                to_string(video.node), name, names.empty() ? "none" : names);
  }
  return {};
}

}  // namespace

Result<NamedControls> set_image_controls(const OpenVideo& video, const NamedControls& wanted,
                                         WriteMode mode) {
  const std::vector<FoundControl> controls = find_controls(video.device);
  if (auto known = check_names(video, wanted, controls); !known)
    return tl::unexpected(known.error());
  NamedControls read_back;
  for (const FoundControl& control : controls) {
    const auto asked = wanted.find(control.name);
    if (asked == wanted.end() && !control.is_bending) continue;
    const Result<std::int32_t> value = asked != wanted.end()
                                           ? wanted_value(video, control, asked->second)
                                           : neutral_value(control);
    if (!value) return tl::unexpected(value.error());
    const auto set = write_control(video, control.info, *value, mode);
    // A driver that refuses the neutral value keeps its own; a camera that is gone is an error.
    const bool is_asked = asked != wanted.end();
    if (!set && (is_asked || set.error().code == ErrorCode::kNotFound))
      return tl::unexpected(set.error());
    if (const auto now = read_control(video.device, control.info.id))
      read_back[control.name] = *now;
  }
  return read_back;
}

}  // namespace flytri::v4l2
