#include "hw/rig/check_rig.h"

#include "core/interchange/calibration_file.h"
#include "hw/v4l2/find_camera.h"

namespace flytri {
namespace {

void append(std::vector<Error>& problems, std::vector<Error> more) {
  problems.insert(problems.end(), more.begin(), more.end());
}

void check_line(std::vector<Error>& problems, const GpioChip& chip, const LineMatch& line) {
  const auto found = find_line(chip, line);
  if (!found) problems.push_back(found.error());
}

}  // namespace

std::vector<Error> check_rig(const RigSettings& rig, VideoSystem& system,
                             const std::vector<GpioChip>& chips) {
  std::vector<Error> problems =
      check_camera(system, rig.measurement.match, rig.measurement.settings);
  if (rig.texture)
    append(problems, check_camera(system, rig.texture->match, rig.texture->settings));
  const auto chip = find_chip(chips, rig.lights.chip);
  if (!chip) {
    problems.push_back(chip.error());
  } else {
    check_line(problems, *chip, rig.lights.vertical);
    check_line(problems, *chip, rig.lights.horizontal);
    if (rig.lights.flash) check_line(problems, *chip, *rig.lights.flash);
  }
  if (rig.calibration) {
    const auto calibration = read_calibration(*rig.calibration);
    if (!calibration) problems.push_back(calibration.error());
  }
  return problems;
}

}  // namespace flytri
