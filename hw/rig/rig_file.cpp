#include "hw/rig/rig_file.h"

#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"

namespace flytri::rig {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

std::string text_or_nothing(const io::JsonPlace& place, std::string_view key) {
  return place.has(key) ? place.at(key).text() : std::string();
}

std::optional<double> positive_or_nothing(const io::JsonPlace& place, std::string_view key) {
  if (!place.has(key)) return std::nullopt;
  return place.at(key).positive_number();
}

device::CameraMatch read_match(const io::JsonPlace& place) {
  device::CameraMatch match{text_or_nothing(place, "name"), text_or_nothing(place, "serial"),
                            text_or_nothing(place, "bus_path")};
  if (match == device::CameraMatch{})
    place.reject("\"name\", \"serial\" or \"bus_path\" of the camera");
  return match;
}

device::PixelFormat read_format(const io::JsonPlace& place) {
  const auto format = device::pixel_format_of(place.text());
  if (!format) place.reject("a pixel format: " + device::pixel_format_names());
  return format.value_or(device::PixelFormat::kGrey8);
}

ImageSize read_size(const io::JsonPlace& place) {
  const auto sides = place.elements();
  if (sides.size() != 2) {
    place.reject("width and height");
    return {1, 1};
  }
  return {sides[0].whole_number(), sides[1].whole_number()};
}

DriverKind read_driver(const io::JsonPlace& place) {
  const auto kind = driver_kind_of(place.text());
  if (!kind) place.reject("\"v4l2\" or \"genicam\"");
  return kind.value_or(DriverKind::kV4l2);
}

RigCamera read_camera(const io::JsonPlace& place, device::Channels channels) {
  RigCamera camera;
  if (place.has("driver")) camera.driver = read_driver(place.at("driver"));
  camera.match = read_match(place.at("match"));
  device::CameraSettings& settings = camera.settings;
  settings.channels = channels;
  settings.format = read_format(place.at("format"));
  settings.size = read_size(place.at("size_px"));
  settings.rate_hz = place.at("rate_hz").positive_number();
  settings.exposure_s = positive_or_nothing(place, "exposure_s");
  if (place.has("gain")) settings.gain = place.at("gain").number();
  settings.white_balance_k = positive_or_nothing(place, "white_balance_k");
  if (place.has("focus")) settings.focus = place.at("focus").number();
  if (place.has("trigger")) settings.trigger = place.at("trigger").text();
  if (place.has("bits")) settings.bits = place.at("bits").whole_number();
  if (place.has("controls")) {
    const io::JsonPlace controls = place.at("controls");
    for (const std::string& name : controls.keys())
      settings.controls[name] = controls.at(name).number();
  }
  if (place.has("readout_s")) camera.readout_s = place.at("readout_s").number();
  return camera;
}

gpio::LineMatch read_line(const io::JsonPlace& place) {
  gpio::LineMatch line;
  if (place.has("line_name")) {
    line.name = place.at("line_name").text();
  } else {
    line.offset = place.at("line").whole_number();
  }
  if (place.has("active")) {
    const std::string active = place.at("active").text();
    if (active != "high" && active != "low") place.at("active").reject("\"high\" or \"low\"");
    line.active_low = active == "low";
  }
  return line;
}

/// Default: the limits of the light.
void read_limit(const io::JsonPlace& place, device::LightLimit& limit) {
  limit.max_on_s = positive_or_nothing(place, "max_on_s").value_or(limit.max_on_s);
  limit.max_duty = positive_or_nothing(place, "max_duty").value_or(limit.max_duty);
}

gpio::LightWiring read_lights(const io::JsonPlace& place) {
  gpio::LightWiring lights;
  const io::JsonPlace chip = place.at("chip");
  lights.chip = {text_or_nothing(chip, "label"), text_or_nothing(chip, "serial"),
                 text_or_nothing(chip, "bus_path")};
  lights.vertical = read_line(place.at("vertical"));
  lights.horizontal = read_line(place.at("horizontal"));
  read_limit(place.at("vertical"), lights.limits.vertical);
  read_limit(place.at("horizontal"), lights.limits.horizontal);
  if (place.has("flash")) {
    lights.flash = read_line(place.at("flash"));
    read_limit(place.at("flash"), lights.limits.flash);
  }
  return lights;
}

void add_text(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

void add_number(Json& json, const char* key, const std::optional<double>& number) {
  if (number) json[key] = *number;
}

Json to_json(const RigCamera& camera) {
  Json match = Json::object();
  add_text(match, "name", camera.match.name);
  add_text(match, "serial", camera.match.serial);
  add_text(match, "bus_path", camera.match.bus_path);
  const device::CameraSettings& settings = camera.settings;
  Json json = Json::object();
  if (camera.driver != DriverKind::kV4l2) json["driver"] = to_string(camera.driver);
  json["match"] = match;
  json["format"] = to_string(settings.format);
  json["size_px"] = {settings.size.width_px, settings.size.height_px};
  json["rate_hz"] = settings.rate_hz;
  add_number(json, "exposure_s", settings.exposure_s);
  add_number(json, "gain", settings.gain);
  add_number(json, "white_balance_k", settings.white_balance_k);
  add_number(json, "focus", settings.focus);
  add_text(json, "trigger", settings.trigger);
  if (settings.bits) json["bits"] = *settings.bits;
  if (!settings.controls.empty()) json["controls"] = settings.controls;
  if (camera.readout_s > 0.0) json["readout_s"] = camera.readout_s;
  return json;
}

Json to_json(const gpio::LineMatch& line, const device::LightLimit& limit) {
  Json json = Json::object();
  if (line.offset) {
    json["line"] = *line.offset;
  } else {
    json["line_name"] = line.name;
  }
  json["active"] = line.active_low ? "low" : "high";
  json["max_on_s"] = limit.max_on_s;
  json["max_duty"] = limit.max_duty;
  return json;
}

Json to_json(const gpio::LightWiring& lights) {
  Json chip = Json::object();
  add_text(chip, "label", lights.chip.label);
  add_text(chip, "serial", lights.chip.serial);
  add_text(chip, "bus_path", lights.chip.bus_path);
  Json json = {{"chip", chip},
               {"vertical", to_json(lights.vertical, lights.limits.vertical)},
               {"horizontal", to_json(lights.horizontal, lights.limits.horizontal)}};
  if (lights.flash) json["flash"] = to_json(*lights.flash, lights.limits.flash);
  return json;
}

}  // namespace

Result<RigSettings> parse_rig(std::string_view text, const std::string& name) {
  const Result<io::JsonPlace> json = io::JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kRigFormat, kVersion);
  RigSettings rig;
  if (json->has("name")) rig.name = json->at("name").text();
  rig.measurement = read_camera(json->at("measurement_camera"), device::Channels::kGrey);
  if (json->has("texture_camera"))
    rig.texture = read_camera(json->at("texture_camera"), device::Channels::kRgb);
  rig.lights = read_lights(json->at("lights"));
  if (json->has("flash_period_s"))
    rig.flash_period_s = json->at("flash_period_s").positive_number();
  if (json->has("calibration")) rig.calibration = json->at("calibration").text();
  if (auto read = json->outcome(); !read) return tl::unexpected(read.error());
  if (auto valid = rig.validate(); !valid)
    return fail(valid.error().code, "{}: {}", name, valid.error().message);
  return rig;
}

Result<RigSettings> read_rig(const std::filesystem::path& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<RigSettings> rig = parse_rig(*text, path.string());
  if (rig && rig->calibration) rig->calibration = path.parent_path() / *rig->calibration;
  return rig;
}

std::string rig_to_json(const RigSettings& rig) {
  Json json = {{"format", kRigFormat},
               {"version", kVersion},
               {"name", rig.name},
               {"measurement_camera", to_json(rig.measurement)}};
  if (rig.texture) json["texture_camera"] = to_json(*rig.texture);
  json["lights"] = to_json(rig.lights);
  json["flash_period_s"] = rig.flash_period_s;
  if (rig.calibration) json["calibration"] = rig.calibration->string();
  return json.dump(1) + "\n";
}

Result<void> write_rig(const std::filesystem::path& path, const RigSettings& rig) {
  return io::write_file(path, rig_to_json(rig));
}

}  // namespace flytri::rig
