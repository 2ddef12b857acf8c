#include "app/session/rig_devices.h"

#include <fmt/format.h>

#include "hw/gpio/gpio_chips.h"
#include "hw/rig/check_rig.h"
#include "hw/rig/rig_file.h"

namespace flytri::session {
namespace {

/// A switch that takes longer than a period at 30 Hz misses the gap between exposures.
constexpr double kSlowSwitch_s = 1.0 / 30.0;

ui::DeviceFigure count(const char* label, std::int64_t value) {
  return {label, fmt::format("{}", value), false};
}
/// Counts something that should not happen.
ui::DeviceFigure fault_count(const char* label, std::int64_t value) {
  return {label, fmt::format("{}", value), value > 0};
}

template <typename Match>
std::string name_of(const Match& match, const std::string& name) {
  if (!name.empty()) return name;
  return match.serial.empty() ? match.bus_path : match.serial;
}

ui::DeviceHealth health_of(device::CameraState state) {
  switch (state) {
    case device::CameraState::kIdle:
      return ui::DeviceHealth::kUnknown;
    case device::CameraState::kRunning:
      return ui::DeviceHealth::kFine;
    default:
      return ui::DeviceHealth::kBroken;
  }
}

ui::DeviceHealth health_of(device::LightSwitchState state) {
  switch (state) {
    case device::LightSwitchState::kIdle:
      return ui::DeviceHealth::kUnknown;
    case device::LightSwitchState::kRunning:
      return ui::DeviceHealth::kFine;
    default:
      return ui::DeviceHealth::kBroken;
  }
}

ui::DeviceState camera_state(ui::Text role, const rig::RigCamera& camera,
                             const rig::RigCameraStatus& status, const ui::Texts& texts) {
  using ui::Text;
  const device::CameraStatus& counts = status.camera;
  ui::DeviceState state;
  state.role = texts[role];
  state.name = name_of(camera.match, camera.match.name);
  state.state = texts.translated(to_string(counts.state));
  state.health = health_of(counts.state);
  state.figures = {count(texts[Text::kLabeled], status.labels.labeled),
                   count(texts[Text::kMixedLight], status.labels.straddled),
                   count(texts[Text::kUnknown], status.labels.unknown),
                   fault_count(texts[Text::kGaps], counts.dropped),
                   fault_count(texts[Text::kDamaged], status.damaged),
                   fault_count(texts[Text::kInterrupted], counts.frozen + counts.lost),
                   {texts[Text::kLatency],
                    status.is_learned ? fmt::format("{:.1f} ms", 1e3 * status.latency.latency_s)
                                      : texts[Text::kMeasuring],
                    false}};
  return state;
}

ui::DeviceState lights_state(const gpio::LightWiring& wiring, const rig::RigStatus& status,
                             const ui::Texts& texts) {
  using ui::Text;
  const device::LightSwitchStatus& counts = status.lights;
  ui::DeviceState state;
  state.role = texts[Text::kLights];
  state.name = name_of(wiring.chip, wiring.chip.label);
  state.state = texts.translated(to_string(counts.state));
  state.health = health_of(counts.state);
  // A switch may report success without any light. Only the images show whether it works.
  const bool is_faulty = status.measurement.fault != sync::LightFault::kNone;
  if (is_faulty && state.health == ui::DeviceHealth::kFine)
    state.health = ui::DeviceHealth::kDoubtful;
  state.figures = {
      count(texts[Text::kSwitched], counts.switched),
      fault_count(texts[Text::kRefused], counts.refused),
      count(texts[Text::kSkipped], counts.skipped),
      fault_count(texts[Text::kInterrupted], counts.lost),
      {texts[Text::kSlowest], fmt::format("{:.1f} ms", 1e3 * counts.slowest_s),
       counts.slowest_s > kSlowSwitch_s},
      {texts[Text::kAPattern], texts.count<Text::kFramesPerPattern>(status.frames_per_pattern),
       false},
      {texts[Text::kInStep], texts[status.keeps_step ? Text::kYes : Text::kNo], false}};
  return state;
}

}  // namespace

Result<rig::RigSettings> chosen_rig(const SourceChoice& choice) {
  Result<rig::RigSettings> rig = rig::read_rig(choice.path);
  if (rig && choice.calibration) rig->calibration = choice.calibration;
  return rig;
}

std::vector<std::string> check_chosen_rig(const SourceChoice& choice) {
  const auto rig = chosen_rig(choice);
  if (!rig) return {rig.error().message};
  std::vector<std::string> problems;
  for (const Error& problem : rig::check_rig(*rig, rig::machine_drivers(), gpio::list_chips()))
    problems.push_back(problem.message);
  return problems;
}

std::vector<ui::DeviceState> device_states(const rig::RigSettings& rig,
                                           const rig::RigStatus& status, const ui::Texts& texts) {
  std::vector<ui::DeviceState> states = {
      camera_state(ui::Text::kMeasurementCamera, rig.measurement, status.measurement, texts)};
  if (rig.texture) {
    states.push_back(camera_state(ui::Text::kTextureCamera, *rig.texture,
                                  status.texture.value_or(rig::RigCameraStatus{}), texts));
  }
  states.push_back(lights_state(rig.lights, status, texts));
  return states;
}

}  // namespace flytri::session
