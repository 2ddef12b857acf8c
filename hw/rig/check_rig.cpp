#include "hw/rig/check_rig.h"

#include "core/io/calibrations/calibration_file.h"
#include "hw/gpio/sequencer_lines.h"
#include "hw/rig/flash_timing.h"

namespace flytri::rig {
namespace {

void append(std::vector<Error>& problems, std::vector<Error> more) {
  problems.insert(problems.end(), more.begin(), more.end());
}

// Both camera entries of the rig may match the same camera.
void check_distinct(std::vector<Error>& problems, const RigSettings& rig,
                    const CameraDrivers& drivers) {
  if (rig.measurement.driver != rig.texture->driver) return;
  stream::CameraDriver& driver = *drivers.of(rig.measurement.driver);
  const auto measurement = driver.find(rig.measurement.match);
  const auto texture = driver.find(rig.texture->match);
  if (!measurement || !texture || measurement->node != texture->node) return;
  problems.push_back({ErrorCode::kInconsistent,
                      fmt::format("camera {} matches both the measurement and the texture camera "
                                  "in rig.json: select each by its serial number or bus path",
                                  measurement->label)});
}

std::vector<Error> check_lines(const gpio::GpioChip& chip, const gpio::LightWiring& lights) {
  std::vector<Error> problems;
  const auto check = [&](const auto& found) {
    if (!found) problems.push_back(found.error());
  };
  check(gpio::find_line(chip, lights.vertical));
  check(gpio::find_line(chip, lights.horizontal));
  if (lights.flash) check(gpio::find_line(chip, *lights.flash));
  // Each line is valid by itself: check them together.
  if (problems.empty()) check(gpio::find_lines(chip, lights));
  return problems;
}

}  // namespace

std::vector<Error> check_rig(const RigSettings& rig, const CameraDrivers& drivers,
                             const std::vector<gpio::GpioChip>& chips) {
  std::vector<Error> problems =
      drivers.of(rig.measurement.driver)->check(rig.measurement.match, rig.measurement.settings);
  if (rig.texture) {
    append(problems,
           drivers.of(rig.texture->driver)->check(rig.texture->match, rig.texture->settings));
    check_distinct(problems, rig, drivers);
    const FlashCameras cameras{rig.measurement.settings, rig.texture->settings,
                               rig.texture->readout_s};
    const auto allowed = check_flash_period(rig.flash_period_s, cameras, rig.lights.limits.flash);
    if (!allowed) problems.push_back(allowed.error());
  }
  const auto chip = gpio::find_chip(chips, rig.lights.chip);
  append(problems, chip ? check_lines(*chip, rig.lights) : std::vector{chip.error()});
  if (chip && rig.is_triggered()) {
    if (auto able = gpio::check_triggers(*chip); !able) problems.push_back(able.error());
  }
  if (rig.calibration) {
    const auto calibration = io::read_calibration(*rig.calibration);
    if (!calibration) problems.push_back(calibration.error());
  }
  return problems;
}

}  // namespace flytri::rig
