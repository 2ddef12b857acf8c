#include "tests/support/fake_devices.h"

namespace flytri::testing {
namespace {

using ui::DeviceHealth;

ui::DeviceState measurement_camera() {
  return {"Measurement camera",
          "Basler daA1280-54um",
          "running",
          DeviceHealth::kFine,
          {{"labeled", "2476"},
           {"straddled", "31"},
           {"unknown", "12"},
           {"gaps", "1", true},
           {"damaged", "0"},
           {"interrupted", "0"},
           {"latency", "21.4 ms"}}};
}

ui::DeviceState texture_camera() {
  return {"Texture camera",
          "C920 HD Pro, serial 8F2A16DF",
          "running",
          DeviceHealth::kFine,
          {{"labeled", "82"},
           {"straddled", "9"},
           {"unknown", "3"},
           {"gaps", "0"},
           {"damaged", "0"},
           {"interrupted", "0"},
           {"latency", "48.0 ms"}}};
}

ui::DeviceState lights() {
  return {"Lights",
          "ftdi-cbus",
          "running",
          DeviceHealth::kFine,
          {{"switched", "2603"},
           {"refused", "0"},
           {"skipped", "2"},
           {"interrupted", "0"},
           {"slowest", "1.9 ms"},
           {"a pattern", "1 frame"},
           {"in step", "yes"}}};
}

}  // namespace

ui::DevicesState running_devices() {
  return {.devices = {measurement_camera(), texture_camera(), lights()},
          .problems = {},
          .is_checked = true,
          .is_checking = false};
}

ui::DevicesState faulty_devices() {
  ui::DevicesState state = running_devices();
  state.devices[1].state = "lost";
  state.devices[1].health = DeviceHealth::kBroken;
  state.devices[1].figures[5] = {"interrupted", "1", true};
  state.devices[2].health = DeviceHealth::kDoubtful;
  state.problems = {
      "The vertical and the horizontal projector are swapped: exchange their cables, or the lines "
      "\"vertical\" and \"horizontal\" in rig.json. Until then, frames are labeled by the pattern "
      "that they show.",
      "No texture: the camera C920 HD Pro is unplugged; plug it in again."};
  return state;
}

std::shared_ptr<const scan::LiveFrame> exposed(const scan::LiveFrame& frame, double factor) {
  auto longer = std::make_shared<scan::LiveFrame>(frame);
  frame.frame.image.convertTo(longer->frame.image, -1, factor);
  return longer;
}

}  // namespace flytri::testing
