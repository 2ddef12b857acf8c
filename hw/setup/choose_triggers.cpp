#include "hw/setup/choose_triggers.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hw/gpio/sequencer_lines.h"
#include "hw/rig/camera_drivers.h"

namespace flytri::setup {
namespace {

/// The trigger inputs of a camera. Names of sockets come first: they begin with "Line".
/// @param cameras  all cameras of this machine
std::vector<std::string> inputs_of(const rig::RigCamera& camera,
                                   const std::vector<device::CameraDescription>& cameras,
                                   const SetupContext& context) {
  const auto found = context.machine.drivers.of(camera.driver)->find(camera.match);
  if (!found) return {};
  for (const device::CameraDescription& each : cameras) {
    if (each.node != found->node) continue;
    std::vector<std::string> inputs = each.trigger_inputs;
    std::stable_partition(inputs.begin(), inputs.end(),
                          [](const std::string& name) { return name.rfind("Line", 0) == 0; });
    return inputs;
  }
  return {};
}

/// The input that the user names; empty: there is no wire.
Result<std::string> choose_input(std::string_view camera, int trigger,
                                 const std::vector<std::string>& inputs,
                                 const SetupContext& context) {
  std::vector<std::string> answers = inputs;
  answers.emplace_back("There is no wire: the cameras run freely");
  const auto answer = context.choose(
      fmt::format("The sequencer can trigger the cameras. To which input of the {} does its "
                  "trigger {} go?",
                  camera, trigger),
      answers);
  if (!answer) return tl::unexpected(answer.error());
  return *answer < inputs.size() ? inputs[*answer] : std::string();
}

bool can_trigger(const rig::RigSettings& rig, const SetupContext& context) {
  const auto chip = gpio::find_chip(context.machine.list_chips(), rig.lights.chip);
  return chip && gpio::check_triggers(*chip);
}

}  // namespace

Result<rig::RigSettings> choose_triggers(const rig::RigSettings& rig, const SetupContext& context) {
  if (!can_trigger(rig, context)) return rig;
  const auto cameras = rig::list_cameras(context.machine.drivers);
  const std::vector<std::string> inputs = inputs_of(rig.measurement, cameras, context);
  const std::vector<std::string> texture_inputs =
      rig.texture ? inputs_of(*rig.texture, cameras, context) : std::vector<std::string>();
  if (inputs.empty() || (rig.texture && texture_inputs.empty())) {
    context.talk.tell(
        "The sequencer could trigger cameras, but not these: a webcam has no trigger input. They "
        "run freely.");
    return rig;
  }
  rig::RigSettings triggered = rig;
  const auto input = choose_input("measurement camera", 0, inputs, context);
  if (!input) return tl::unexpected(input.error());
  if (input->empty()) return rig;
  triggered.measurement.settings.trigger = *input;
  if (!rig.texture) return triggered;
  const auto texture_input = choose_input("texture camera", 1, texture_inputs, context);
  if (!texture_input) return tl::unexpected(texture_input.error());
  if (texture_input->empty()) return rig;
  triggered.texture->settings.trigger = *texture_input;
  return triggered;
}

}  // namespace flytri::setup
