#include "hw/rig/rig_message.h"

namespace flytri::rig {
namespace {

void add(std::string& message, const std::string& more) {
  if (more.empty()) return;
  if (!message.empty()) message += " ";
  message += more;
}

/// The flash is for the texture camera. If that camera sees it, the measurement camera need not.
sync::LightFault fault_of(const RigStatus& status) {
  const sync::LightFault fault = status.measurement.fault;
  const bool is_flash_seen = status.texture && status.texture->fault == sync::LightFault::kNone;
  return fault == sync::LightFault::kNoFlash && is_flash_seen ? sync::LightFault::kNone : fault;
}

}  // namespace

std::string rig_message(const RigStatus& status, const std::string& texture_failure) {
  std::string message;
  add(message, status.measurement.camera.message);
  add(message, status.lights.message);
  // If a device is unplugged, the images do not tell whether the lights work.
  if (message.empty()) add(message, sync::message_of(fault_of(status)));
  if (!texture_failure.empty())
    add(message, fmt::format("No texture: {}", texture_failure));
  else if (status.texture)
    add(message, status.texture->camera.message);
  return message;
}

std::string rig_summary(const RigStatus& status) {
  const RigCameraStatus& camera = status.measurement;
  const std::string latency = camera.is_learned
                                  ? fmt::format("latency {:.1f} ms", 1e3 * camera.latency.latency_s)
                                  : std::string("learning the latency");
  return fmt::format("{} labeled, {} straddled, {} unknown, {} dropped, {} damaged; {}",
                     camera.labels.labeled, camera.labels.straddled, camera.labels.unknown,
                     camera.camera.dropped, camera.damaged, latency);
}

}  // namespace flytri::rig
