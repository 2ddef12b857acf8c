/// @file  What a session does about the devices of a rig.
#include "app/session/rig_devices.h"
#include "app/session/session.h"

namespace flytri::session {

void Session::retry_source() {
  if (source_.sensor == nullptr) return open_chosen_source();
  if (capture_ != nullptr && capture_->status().state == device::SensorState::kFailed)
    start_capture();
}

/// While the devices run they say themselves what is wrong: a look at them from outside would only
/// find them in use.
void Session::handle(const ui::CheckDevices&) {
  if (!options_.source.rig || devices_check_.is_checking) return;
  const bool is_running =
      capture_ != nullptr && capture_->status().state == device::SensorState::kRunning;
  if (is_running) {
    devices_check_.problems.clear();
    devices_check_.is_checked = true;
    return;
  }
  devices_check_.is_checking = true;
  do_in_background([this, choice = options_.source] {
    auto problems = std::make_shared<std::vector<std::string>>(check_chosen_rig(choice));
    return [this, problems] {
      devices_check_.problems = *problems;
      devices_check_.is_checked = true;
      devices_check_.is_checking = false;
      if (problems->empty()) retry_source();
    };
  });
}

std::optional<ui::DevicesState> Session::devices_state(const ui::SourceState& source) const {
  if (!options_.source.rig) return std::nullopt;
  ui::DevicesState state = devices_check_;
  if (source_.rig)
    state.devices = device_states(source_.rig->settings, source_.rig->sensor->rig_status());
  // What was found before they ran is mended.
  if (source.is_running) state.problems.clear();
  state.is_checked = state.is_checked || source.is_running;
  if (source.message.empty() || (!source.is_running && !source.is_lost)) return state;
  std::erase(state.problems, source.message);
  state.problems.insert(state.problems.begin(), source.message);
  return state;
}

}  // namespace flytri::session
