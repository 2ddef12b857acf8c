#include "hw/rig/check_rig.h"

#include "core/interchange/calibration_file.h"
#include "hw/v4l2/find_camera.h"
#include "hw/v4l2/video_failure.h"

namespace flytri {
namespace {

void append(std::vector<Error>& problems, std::vector<Error> more) {
  problems.insert(problems.end(), more.begin(), more.end());
}

// What the rig says of its cameras may fit one and the same.
void check_distinct(std::vector<Error>& problems, const RigSettings& rig, VideoSystem& system) {
  const auto measurement = find_camera(system, rig.measurement.match);
  const auto texture = find_camera(system, rig.texture->match);
  if (!measurement || !texture || measurement->node != texture->node) return;
  problems.push_back({ErrorCode::kInconsistent,
                      fmt::format("camera {} is both the measurement and the texture camera: tell "
                                  "them apart by their serial numbers or bus paths",
                                  to_string(*measurement))});
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
  if (rig.texture) {
    append(problems, check_camera(system, rig.texture->match, rig.texture->settings));
    check_distinct(problems, rig, system);
  }
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
