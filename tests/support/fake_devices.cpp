#include "tests/support/fake_devices.h"

namespace flytri::testing {
namespace {

using ui::DeviceHealth;
using ui::Text;

ui::DeviceState measurement_camera(const ui::Texts& texts) {
  return {texts[Text::kMeasurementCamera],
          "Basler daA1280-54um",
          texts[Text::kDeviceRunning],
          DeviceHealth::kFine,
          {{texts[Text::kLabeled], "2476"},
           {texts[Text::kMixedLight], "31"},
           {texts[Text::kUnknown], "12"},
           {texts[Text::kGaps], "1", true},
           {texts[Text::kDamaged], "0"},
           {texts[Text::kInterrupted], "0"},
           {texts[Text::kLatency], "21.4 ms"}}};
}

ui::DeviceState texture_camera(const ui::Texts& texts) {
  return {texts[Text::kTextureCamera],
          "C920 HD Pro, serial 8F2A16DF",
          texts[Text::kDeviceRunning],
          DeviceHealth::kFine,
          {{texts[Text::kLabeled], "82"},
           {texts[Text::kMixedLight], "9"},
           {texts[Text::kUnknown], "3"},
           {texts[Text::kGaps], "0"},
           {texts[Text::kDamaged], "0"},
           {texts[Text::kInterrupted], "0"},
           {texts[Text::kLatency], "48.0 ms"}}};
}

ui::DeviceState lights(const ui::Texts& texts) {
  return {texts[Text::kLights],
          "ftdi-cbus",
          texts[Text::kDeviceRunning],
          DeviceHealth::kFine,
          {{texts[Text::kSwitched], "2603"},
           {texts[Text::kRefused], "0"},
           {texts[Text::kSkipped], "2"},
           {texts[Text::kInterrupted], "0"},
           {texts[Text::kSlowest], "1.9 ms"},
           {texts[Text::kAPattern], texts.count<Text::kFramesPerPattern>(1)},
           {texts[Text::kInStep], texts[Text::kYes]}}};
}

}  // namespace

ui::DevicesState running_devices(const ui::Texts& texts) {
  return {.devices = {measurement_camera(texts), texture_camera(texts), lights(texts)},
          .problems = {},
          .is_checked = true,
          .is_checking = false};
}

ui::DevicesState faulty_devices(const ui::Texts& texts) {
  ui::DevicesState state = running_devices(texts);
  state.devices[1].state = texts[Text::kDeviceLost];
  state.devices[1].health = DeviceHealth::kBroken;
  state.devices[1].figures[5] = {texts[Text::kInterrupted], "1", true};
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
