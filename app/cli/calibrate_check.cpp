#include "app/cli/calibrate_check.h"

#include <fmt/format.h>

#include <memory>

#include "app/cli/chair_dialog.h"
#include "core/calibrating/hold_check.h"
#include "core/interchange/calibration_file.h"
#include "hw/chair/hold_shots.h"
#include "hw/chair/open_shots.h"

namespace flytri::cli {
namespace {

void print(const HoldReport& report) {
  constexpr double kMicrons = 1e3;
  fmt::print("{:<28} {:>12} {:>14} {:>10}\n", "at the border of the volume", "deviation",
             "uncertainty", "limit");
  for (const HoldFigure& figure : report.figures) {
    fmt::print("{:<28} {:>+9.1f} um {:>11.1f} um {:>7.1f} um  {}\n", figure.name,
               kMicrons * figure.deviation_mm, kMicrons * figure.uncertainty_mm,
               kMicrons * figure.limit_mm, figure.good() ? "good" : "TOO MUCH");
  }
}

Result<std::vector<HoldPose>> take_poses(const CalibrateCheckArguments& arguments,
                                         const Calibration& calibration, const Progress& progress) {
  auto source = open_shots({arguments.simulated, arguments.sensor, arguments.rig});
  if (!source) return tl::unexpected(source.error());
  if (auto started = (*source)->start(); !started) return tl::unexpected(started.error());
  Prompt prompt(progress);
  std::vector<HoldPose> poses;
  const auto places = hold_places();
  while (poses.size() < places.size()) {
    const HoldPlace& place = places[poses.size()];
    const auto line = prompt.ask(
        fmt::format("{} of {}: put the {} {} and let it rest, then press Enter. ", poses.size() + 1,
                    places.size(), arguments.sphere_mm > 0.0 ? "sphere" : "plane", place.words));
    if (!line) return stopped();
    fmt::print("\n");
    auto pose = take_hold_pose(**source, place.depth_share * calibration.volume.size_mm.z(),
                               calibration, progress);
    if (pose) {
      poses.push_back(*std::move(pose));
    } else if (pose.error().code == ErrorCode::kInconsistent) {
      fmt::print("  again: {}\n", pose.error().message);
    } else {
      return tl::unexpected(pose.error());
    }
  }
  return poses;
}

Result<void> conclude(const HoldReport& report) {
  print(report);
  if (report.outcome == HoldOutcome::kUnclear) {
    return fail(ErrorCode::kInsufficient, "no verdict: {}", report.reason);
  }
  if (report.outcome == HoldOutcome::kHolds) {
    fmt::print("the calibration holds\n");
    return {};
  }
  for (const std::string& meaning : report.meanings) fmt::print("{}\n", meaning);
  return fail(ErrorCode::kInconsistent,
              "the calibration no longer holds; calibrate anew with flytri calibrate --live");
}

}  // namespace

Result<void> calibrate_check(const CalibrateCheckArguments& arguments, const Progress& progress) {
  const auto calibration = read_calibration(arguments.calibration);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto poses = arguments.recording.empty()
                         ? take_poses(arguments, *calibration, progress)
                         : read_hold_poses(arguments.recording, *calibration, progress);
  if (!poses) return tl::unexpected(poses.error());
  const auto report = arguments.sphere_mm > 0.0
                          ? check_on_sphere(*poses, arguments.sphere_mm, *calibration)
                          : check_on_plane(*poses, *calibration);
  if (!report) return tl::unexpected(report.error());
  return conclude(*report);
}

}  // namespace flytri::cli
