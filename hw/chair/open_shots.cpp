#include "hw/chair/open_shots.h"

#include <utility>

#include "hw/chair/rig_shots.h"
#include "hw/chair/simulated_shots.h"
#include "hw/rig/rig_file.h"

namespace flytri {

SensorModel sensor_named(const std::string& name) {
  return name == "face" ? face_sensor() : intraoral_sensor();
}

Result<std::shared_ptr<ShotSource>> open_shots(const ShotChoice& choice) {
  if (choice.simulated) {
    auto shots = SimulatedShots::create(sensor_named(choice.sensor));
    if (!shots) return tl::unexpected(shots.error());
    return std::shared_ptr<ShotSource>(*std::move(shots));
  }
  const auto rig = read_rig(choice.rig);
  if (!rig) return tl::unexpected(rig.error());
  auto shots = open_rig_shots(*rig);
  if (!shots) return tl::unexpected(shots.error());
  return std::shared_ptr<ShotSource>(*std::move(shots));
}

}  // namespace flytri
