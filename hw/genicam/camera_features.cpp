#include "hw/genicam/camera_features.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "hw/device/c_text.h"
#include "hw/genicam/pixel_formats.h"

namespace flytri::genicam {
namespace {

constexpr double kMicroseconds = 1e6;

/// A feature that changes the gray values, and the value at which it does not.
struct Neutral {
  const char* feature;
  double value;
};
/// @source  EMVA, "GenICam Standard Features Naming Convention" (SFNC) 2.7. Switches: 0 or 1.
constexpr std::array kNeutral = {Neutral{"GammaEnable", 0.0},     Neutral{"Gamma", 1.0},
                                 Neutral{"SharpnessEnable", 0.0}, Neutral{"LUTEnable", 0.0},
                                 Neutral{"NoiseReduction", 0.0},  Neutral{"Sharpness", 0.0}};
constexpr std::array kAutomatic = {"ExposureAuto", "GainAuto", "BalanceWhiteAuto", "BlackLevelAuto",
                                   "GammaAuto"};

bool has_feature(ArvCamera& camera, const char* feature) {
  ArvFailure failure;
  return arv_camera_is_feature_available(&camera, feature, failure.out()) != 0 && !failure;
}

/// A feature that is one number or a switch.
class NumberFeature {
 public:
  /// Nothing if the camera lacks the feature, or it is no number.
  static std::optional<NumberFeature> find(ArvCamera& camera, const std::string& name) {
    ArvGcNode* const node = arv_device_get_feature(arv_camera_get_device(&camera), name.c_str());
    if (node == nullptr || !has_feature(camera, name.c_str())) return std::nullopt;
    const bool is_number = ARV_IS_GC_FLOAT(node) || ARV_IS_GC_BOOLEAN(node) ||
                           (ARV_IS_GC_INTEGER(node) && !ARV_IS_GC_ENUMERATION(node));
    if (!is_number) return std::nullopt;
    return NumberFeature(camera, name, node);
  }

  [[nodiscard]] std::optional<device::CameraControl> read() const {
    device::CameraControl control;
    control.name = name_;
    ArvFailure failure;
    if (ARV_IS_GC_BOOLEAN(node_)) {
      control.maximum = control.step = 1.0;
      control.value = arv_camera_get_boolean(&camera_, name_.c_str(), failure.out()) ? 1.0 : 0.0;
    } else if (ARV_IS_GC_FLOAT(node_)) {
      control.value = arv_camera_get_float(&camera_, name_.c_str(), failure.out());
      if (failure) return std::nullopt;
      arv_camera_get_float_bounds(&camera_, name_.c_str(), &control.minimum, &control.maximum,
                                  failure.out());
    } else {
      gint64 least = 0, most = 0;
      control.value =
          static_cast<double>(arv_camera_get_integer(&camera_, name_.c_str(), failure.out()));
      if (failure) return std::nullopt;
      arv_camera_get_integer_bounds(&camera_, name_.c_str(), &least, &most, failure.out());
      control.minimum = static_cast<double>(least);
      control.maximum = static_cast<double>(most);
      control.step = 1.0;
    }
    if (failure) return std::nullopt;
    return control;
  }

  void write(double value, ArvFailure& failure) const {
    if (ARV_IS_GC_BOOLEAN(node_))
      arv_camera_set_boolean(&camera_, name_.c_str(), value != 0.0, failure.out());
    else if (ARV_IS_GC_FLOAT(node_))
      arv_camera_set_float(&camera_, name_.c_str(), value, failure.out());
    else
      arv_camera_set_integer(&camera_, name_.c_str(), std::llround(value), failure.out());
  }

 private:
  NumberFeature(ArvCamera& camera, std::string name, ArvGcNode* node)
      : camera_(camera), name_(std::move(name)), node_(node) {}

  ArvCamera& camera_;
  std::string name_;
  ArvGcNode* node_;
};

std::string range_text(double least, double most) {
  return fmt::format("{:g} to {:g}", least, most);
}

Error out_of_range(const OpenCamera& open, std::string_view what, double value, double least,
                   double most) {
  return {ErrorCode::kBadOption, fmt::format("camera {}: {} is {:g}, but must be in {}", open.label,
                                             what, value, range_text(least, most))};
}

std::vector<std::string> format_names(ArvCamera& camera) {
  ArvFailure failure;
  guint count = 0;
  const OwnedArray<const char*> names(
      arv_camera_dup_available_pixel_formats_as_strings(&camera, &count, failure.out()));
  if (!names) return {};
  return {names.get(), names.get() + count};
}

struct Bounds {
  int least = 0;
  int most = 0;
};

/// Width and height that the chip allows, at offset 0.
std::pair<Bounds, Bounds> size_bounds(ArvCamera& camera) {
  Bounds width, height;
  ArvFailure failure;
  arv_camera_get_width_bounds(&camera, &width.least, &width.most, failure.out());
  arv_camera_get_height_bounds(&camera, &height.least, &height.most, failure.out());
  // With an offset, the bounds are those of the rest of the chip.
  int chip_width = 0, chip_height = 0;
  arv_camera_get_sensor_size(&camera, &chip_width, &chip_height, failure.out());
  if (!failure) {
    width.most = std::max(width.most, chip_width);
    height.most = std::max(height.most, chip_height);
  }
  return {width, height};
}

Result<std::string> format_name(const OpenCamera& open, device::PixelFormat format) {
  const std::vector<std::string> offered = format_names(open.camera);
  std::string names;
  for (const std::string& name : offered) {
    const auto known = pixel_format_of_genicam(name);
    if (known == format) return name;
    if (known) names += (names.empty() ? "" : ", ") + std::string(to_string(*known));
  }
  return fail(ErrorCode::kBadOption, "camera {} does not offer {}: choose one of {}", open.label,
              to_string(format), names.empty() ? "none" : names);
}

Result<void> check_size(const OpenCamera& open, const ImageSize& size) {
  const auto [width, height] = size_bounds(open.camera);
  if (size.width_px >= width.least && size.width_px <= width.most &&
      size.height_px >= height.least && size.height_px <= height.most)
    return {};
  return fail(ErrorCode::kBadOption,
              "camera {} does not offer {} x {} pixels: choose {} x {} to {} x {} as size_px",
              open.label, size.width_px, size.height_px, width.least, height.least, width.most,
              height.most);
}

std::vector<std::string> trigger_sources(ArvCamera& camera) {
  ArvFailure failure;
  guint count = 0;
  const OwnedArray<const char*> names(
      arv_camera_dup_available_trigger_sources(&camera, &count, failure.out()));
  if (!names) return {};
  return {names.get(), names.get() + count};
}

Result<void> check_trigger(const OpenCamera& open, const std::string& trigger) {
  if (trigger.empty()) return {};
  const std::vector<std::string> inputs = trigger_sources(open.camera);
  if (std::find(inputs.begin(), inputs.end(), trigger) != inputs.end()) return {};
  return fail(ErrorCode::kBadOption, "camera {} has no trigger input \"{}\": choose one of {}",
              open.label, trigger,
              inputs.empty() ? "none" : fmt::format("{}", fmt::join(inputs, ", ")));
}

Result<void> check_controls(const OpenCamera& open, const device::CameraSettings& settings) {
  for (const auto& [name, value] : settings.controls) {
    const auto feature = NumberFeature::find(open.camera, name);
    if (!feature)
      return fail(ErrorCode::kBadOption,
                  "camera {} has no number or switch \"{}\": remove it from \"controls\" in "
                  "rig.json, or use the name that the maker gives",
                  open.label, name);
    const auto control = feature->read();
    if (control && (value < control->minimum || value > control->maximum))
      return tl::unexpected(out_of_range(open, name, value, control->minimum, control->maximum));
  }
  const auto refuse = [&](std::string_view key) -> Result<void> {
    return fail(ErrorCode::kBadOption,
                "camera {}: \"{}\" cannot be set with driver genicam: remove it from rig.json, or "
                "name the camera's own feature in \"controls\"",
                open.label, key);
  };
  if (settings.focus) return refuse("focus");
  if (settings.white_balance_k) return refuse("white_balance_k");
  return {};
}

Result<void> set_region(const OpenCamera& open, const ImageSize& size) {
  ArvFailure failure;
  const auto [width, height] = size_bounds(open.camera);
  // The size first at offset 0, since an offset limits it.
  arv_camera_set_region(&open.camera, 0, 0, size.width_px, size.height_px, failure.out());
  if (failure) return tl::unexpected(failure.told(open.label, "setting the size"));
  if (arv_camera_is_region_offset_available(&open.camera, failure.out())) {
    const auto middle = [](int whole, int part, int increment) {
      return (whole - part) / 2 / std::max(increment, 1) * std::max(increment, 1);
    };
    const int x = middle(width.most, size.width_px,
                         arv_camera_get_x_offset_increment(&open.camera, failure.out()));
    const int y = middle(height.most, size.height_px,
                         arv_camera_get_y_offset_increment(&open.camera, failure.out()));
    arv_camera_set_region(&open.camera, x, y, size.width_px, size.height_px, failure.out());
    if (failure) return tl::unexpected(failure.told(open.label, "setting the place on the chip"));
  }
  int x = 0, y = 0, agreed_width = 0, agreed_height = 0;
  arv_camera_get_region(&open.camera, &x, &y, &agreed_width, &agreed_height, failure.out());
  if (failure) return tl::unexpected(failure.told(open.label, "reading the size"));
  if (agreed_width == size.width_px && agreed_height == size.height_px) return {};
  return fail(
      ErrorCode::kBadOption,
      "camera {} gives {} x {} pixels instead of {} x {}: write this as size_px in rig.json",
      open.label, agreed_width, agreed_height, size.width_px, size.height_px);
}

/// Cameras that lack a feature, or refuse the value, keep their own.
void set_neutral(ArvCamera& camera) {
  ArvFailure ignored;
  for (const char* feature : kAutomatic)
    if (has_feature(camera, feature)) arv_camera_set_string(&camera, feature, "Off", ignored.out());
  for (const Neutral& neutral : kNeutral)
    if (const auto feature = NumberFeature::find(camera, neutral.feature))
      feature->write(neutral.value, ignored);
}

Result<void> set_exposure(const OpenCamera& open, double exposure_s) {
  ArvFailure failure;
  double least = 0.0, most = 0.0;
  arv_camera_get_exposure_time_bounds(&open.camera, &least, &most, failure.out());
  const double wanted = exposure_s * kMicroseconds;
  if (!failure && (wanted < least || wanted > most))
    return tl::unexpected(
        out_of_range(open, "exposure_s", exposure_s, least / kMicroseconds, most / kMicroseconds));
  arv_camera_set_exposure_time(&open.camera, wanted, failure.out());
  if (failure) return tl::unexpected(failure.told(open.label, "setting the exposure"));
  return {};
}

Result<void> set_gain(const OpenCamera& open, double gain) {
  ArvFailure failure;
  double least = 0.0, most = 0.0;
  arv_camera_get_gain_bounds(&open.camera, &least, &most, failure.out());
  if (!failure && (gain < least || gain > most))
    return tl::unexpected(out_of_range(open, "gain", gain, least, most));
  arv_camera_set_gain(&open.camera, gain, failure.out());
  if (failure) return tl::unexpected(failure.told(open.label, "setting the gain"));
  return {};
}

Result<void> set_controls(const OpenCamera& open, const device::CameraSettings& settings) {
  set_neutral(open.camera);
  if (settings.exposure_s)
    if (auto set = set_exposure(open, *settings.exposure_s); !set) return set;
  if (settings.gain)
    if (auto set = set_gain(open, *settings.gain); !set) return set;
  for (const auto& [name, value] : settings.controls) {
    ArvFailure failure;
    NumberFeature::find(open.camera, name)->write(value, failure);
    if (failure) return tl::unexpected(failure.told(open.label, "setting " + name));
  }
  return {};
}

/// The camera's answer to the rate; the one asked for if it does not say.
Result<double> set_rate(const OpenCamera& open, double rate_hz) {
  ArvFailure failure;
  if (!arv_camera_is_frame_rate_available(&open.camera, failure.out())) return rate_hz;
  arv_camera_set_frame_rate(&open.camera, rate_hz, failure.out());
  if (failure)
    return tl::unexpected(
        failure.told(open.label, fmt::format("setting the rate to {} Hz", rate_hz)));
  const double agreed_hz = arv_camera_get_frame_rate(&open.camera, failure.out());
  return failure || !(agreed_hz > 0.0) ? rate_hz : agreed_hz;
}

void read_back(ArvCamera& camera, device::CameraSettings& settings) {
  ArvFailure failure;
  const double exposure_us = arv_camera_get_exposure_time(&camera, failure.out());
  settings.exposure_s.reset();
  if (!failure) settings.exposure_s = exposure_us / kMicroseconds;
  const double gain = arv_camera_get_gain(&camera, failure.out());
  settings.gain.reset();
  if (!failure) settings.gain = gain;
  for (auto& [name, value] : settings.controls) {
    const auto feature = NumberFeature::find(camera, name);
    const auto control = feature ? feature->read() : std::nullopt;
    if (control) value = control->value;
  }
}

}  // namespace

Result<void> check_settings(const OpenCamera& open, const device::CameraSettings& settings) {
  if (const auto name = format_name(open, settings.format); !name)
    return tl::unexpected(name.error());
  if (auto size = check_size(open, settings.size); !size) return size;
  if (auto trigger = check_trigger(open, settings.trigger); !trigger) return trigger;
  return check_controls(open, settings);
}

Result<device::CameraSettings> set_up(const OpenCamera& open,
                                      const device::CameraSettings& settings) {
  if (auto checked = check_settings(open, settings); !checked)
    return tl::unexpected(checked.error());
  ArvFailure failure;
  arv_camera_set_acquisition_mode(&open.camera, ARV_ACQUISITION_MODE_CONTINUOUS, failure.out());
  if (failure) return tl::unexpected(failure.told(open.label, "setting continuous images"));
  arv_camera_clear_triggers(&open.camera, failure.out());
  if (failure) return tl::unexpected(failure.told(open.label, "turning the trigger off"));
  const auto name = format_name(open, settings.format);
  if (!name) return tl::unexpected(name.error());
  arv_camera_set_pixel_format_from_string(&open.camera, name->c_str(), failure.out());
  if (failure) return tl::unexpected(failure.told(open.label, "setting the format"));
  if (auto set = set_region(open, settings.size); !set) return tl::unexpected(set.error());
  if (auto set = set_controls(open, settings); !set) return tl::unexpected(set.error());
  const auto rate_hz = set_rate(open, settings.rate_hz);
  if (!rate_hz) return tl::unexpected(rate_hz.error());
  if (!settings.trigger.empty()) {
    // Last, as it turns off the camera's own rate.
    arv_camera_set_trigger(&open.camera, settings.trigger.c_str(), failure.out());
    if (failure)
      return tl::unexpected(failure.told(open.label, "setting the trigger " + settings.trigger));
  }
  device::CameraSettings agreed = settings;
  agreed.rate_hz = *rate_hz;
  read_back(open.camera, agreed);
  return agreed;
}

std::vector<device::CameraMode> list_modes(ArvCamera& camera) {
  const auto [width, height] = size_bounds(camera);
  device::CameraMode mode;
  mode.size = {width.most, height.most};
  ArvFailure failure;
  double least_hz = 0.0, most_hz = 0.0;
  arv_camera_get_frame_rate_bounds(&camera, &least_hz, &most_hz, failure.out());
  if (!failure) mode.rates_hz = {most_hz, least_hz};
  std::vector<device::CameraMode> modes;
  for (const std::string& name : format_names(camera)) {
    const auto known = pixel_format_of_genicam(name);
    mode.format = known ? std::string(to_string(*known)) : name;
    modes.push_back(mode);
  }
  return modes;
}

std::vector<std::string> list_trigger_inputs(ArvCamera& camera) {
  std::vector<std::string> inputs = trigger_sources(camera);
  std::erase(inputs, "Software");
  return inputs;
}

std::vector<device::CameraControl> list_controls(ArvCamera& camera) {
  constexpr std::array kShown = {"ExposureTime", "Gain",      "BlackLevel",
                                 "Gamma",        "Sharpness", "NoiseReduction"};
  std::vector<device::CameraControl> controls;
  for (const char* name : kShown) {
    const auto feature = NumberFeature::find(camera, name);
    const auto control = feature ? feature->read() : std::nullopt;
    if (control) controls.push_back(*control);
  }
  return controls;
}

}  // namespace flytri::genicam
