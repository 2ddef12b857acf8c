#include "hw/device/light_switch.h"

namespace flytri::device {

std::string_view to_string(Light light) {
  switch (light) {
    case Light::kDark:
      return "dark";
    case Light::kVertical:
      return "vertical";
    case Light::kHorizontal:
      return "horizontal";
    case Light::kFlash:
      break;
  }
  return "flash";
}

std::string_view to_string(LightSwitchState state) {
  switch (state) {
    case LightSwitchState::kIdle:
      return "idle";
    case LightSwitchState::kRunning:
      return "running";
    case LightSwitchState::kLost:
      return "lost";
    case LightSwitchState::kFailed:
      break;
  }
  return "failed";
}

}  // namespace flytri::device
