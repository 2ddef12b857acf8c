#include "hw/shots/open_shots.h"

#include <utility>

#include "hw/rig/rig_file.h"
#include "hw/shots/rig_shots.h"
#include "hw/shots/simulated_shots.h"
#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::shots {

simulated::SensorModel sensor_named(const std::string& name) {
  return make_sensor(simulated::layout_named(name));
}

Result<std::shared_ptr<ShotSource>> open_shots(const ShotChoice& choice) {
  if (choice.simulated) {
    auto shots =
        SimulatedShots::create(sensor_named(choice.sensor), {.exposures = choice.exposures});
    if (!shots) return tl::unexpected(shots.error());
    return std::shared_ptr<ShotSource>(*std::move(shots));
  }
  const auto rig = rig::read_rig(choice.rig);
  if (!rig) return tl::unexpected(rig.error());
  auto shots = open_rig_shots(*rig, choice.exposures);
  if (!shots) return tl::unexpected(shots.error());
  return std::shared_ptr<ShotSource>(*std::move(shots));
}

}  // namespace flytri::shots
