#include "hw/rig/rig_settings.h"

#include "core/base/check_options.h"

namespace flytri::rig {

Result<void> RigCamera::validate() const {
  return OptionCheck("RigCamera")
      .must("match", "empty", match != device::CameraMatch{}, "a name, serial number or bus path")
      .not_negative("readout_s", readout_s)
      .must("trigger", settings.trigger, settings.trigger.empty() || driver == DriverKind::kGenicam,
            "left out, or \"driver\" must be \"genicam\"")
      .nested(settings)
      .result();
}

bool RigSettings::is_triggered() const { return !measurement.settings.trigger.empty(); }

RigSettings RigSettings::free_running() const {
  RigSettings rig = *this;
  rig.measurement.settings.trigger.clear();
  if (rig.texture) rig.texture->settings.trigger.clear();
  return rig;
}

Result<void> RigSettings::validate() const {
  OptionCheck check("RigSettings");
  check.nested(measurement)
      .must("measurement.settings.channels", "color",
            measurement.settings.channels == device::Channels::kGrey, "grey");
  if (texture) {
    check.nested(*texture)
        .must("lights.flash", "missing", lights.flash.has_value(),
              "set, as there is a texture camera")
        .must("texture.settings.trigger", texture->settings.trigger,
              texture->settings.trigger.empty() == measurement.settings.trigger.empty(),
              "given for both cameras or for none");
  }
  return check.positive("flash_period_s", flash_period_s).nested(lights).result();
}

}  // namespace flytri::rig
