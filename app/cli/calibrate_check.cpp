#include "app/cli/calibrate_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string_view>

#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/cli/prompt.h"
#include "app/session/calibration_files.h"
#include "core/calibration/verify/compare_calibrations.h"
#include "core/calibration/verify/verify.h"
#include "core/io/calibrations/calibration_file.h"
#include "hw/shots/open_shots.h"
#include "hw/shots/verification_shots.h"

namespace flytri::cli {
namespace {

void print(const calibration::VerificationReport& report) {
  constexpr double kMicrons = 1e3;
  print_out("{:<28} {:>12} {:>14} {:>10}\n", "at the border of the volume", "deviation",
            "uncertainty", "limit");
  for (const calibration::VerificationFigure& figure : report.figures) {
    print_out("{:<28} {:>+9.1f} µm {:>11.1f} µm {:>7.1f} µm  {}\n", figure.name,
              kMicrons * figure.deviation_mm, kMicrons * figure.uncertainty_mm,
              kMicrons * figure.limit_mm, figure.good() ? "good" : "TOO MUCH");
  }
}

Result<std::vector<calibration::VerificationPose>> take_poses(
    const CalibrateCheckArguments& arguments, const calibration::Calibration& calibration,
    const Progress& progress) {
  auto source = shots::open_shots({arguments.simulated, arguments.sensor, arguments.rig});
  if (!source) return tl::unexpected(source.error());
  if (auto started = (*source)->start(); !started) return tl::unexpected(started.error());
  Prompt prompt(progress);
  std::vector<calibration::VerificationPose> poses;
  const auto places = shots::verification_places();
  while (poses.size() < places.size()) {
    const shots::VerificationPlace& place = places[poses.size()];
    const auto line = prompt.ask(fmt::format(
        "{} of {}: put the {} {} and keep it still, then press Enter. ", poses.size() + 1,
        places.size(), arguments.sphere_mm > 0.0 ? "sphere" : "plane", place.words));
    if (!line) return stopped();
    print_out("\n");
    auto pose = shots::take_verification_pose(
        **source, place.depth_share * calibration.volume.size_mm.z(), calibration, progress);
    if (pose) {
      poses.push_back(*std::move(pose));
    } else if (pose.error().code == ErrorCode::kInconsistent) {
      print_out("  take this one again: {}\n", pose.error().message);
    } else {
      return tl::unexpected(pose.error());
    }
  }
  return poses;
}

/// @param failure  what it means, and what to do, if the calibration does not hold
Result<void> conclude(const calibration::VerificationReport& report, std::string_view failure) {
  print(report);
  if (report.outcome == calibration::VerificationOutcome::kUnclear) {
    return fail(ErrorCode::kInsufficient, "no verdict: {}", report.reason);
  }
  if (report.outcome == calibration::VerificationOutcome::kValid) {
    print_out("the calibration holds\n");
    return {};
  }
  for (const std::string& meaning : report.meanings) print_out("{}\n", meaning);
  return fail(ErrorCode::kInconsistent, "{}", failure);
}

/// Largest standard uncertainty with which a correction is better than none.
constexpr double kSureAngle_deg = 0.03;
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

void print(const calibration::CalibrationComparison& comparison) {
  constexpr double kPercent = 1e2, kMicrons = 1e3;
  const calibration::MetricCorrection& correction = comparison.correction;
  const Eigen::Vector2d sigma_deg = kDegreesPerRadian * comparison.shear_sigma;
  print_out("stage to target: {:+.3f}° ± {:.4f}° along x, {:+.3f}° ± {:.4f}° along y\n",
            kDegreesPerRadian * std::atan(correction.shear.x()), sigma_deg.x(),
            kDegreesPerRadian * std::atan(correction.shear.y()), sigma_deg.y());
  print_out("scale: {:+.3f} % ± {:.3f} % across, {:+.3f} % ± {:.3f} % in depth\n",
            kPercent * (correction.lateral - 1.0), kPercent * comparison.lateral_sigma,
            kPercent * (correction.depth - 1.0), kPercent * comparison.depth_sigma);
  print_out("without these the calibrations differ by {:.1f} µm; errors of the board come on top\n",
            kMicrons * comparison.left_mm);
}

/// Writes the calibration with the millimeters of the other one.
Result<void> correct(const CalibrateCheckArguments& arguments,
                     const calibration::Calibration& calibration,
                     const calibration::CalibrationComparison& comparison) {
  const double angle_deg = kDegreesPerRadian * comparison.shear_sigma.maxCoeff();
  if (angle_deg > kSureAngle_deg)
    return fail(ErrorCode::kInsufficient,
                "not corrected: the angle is known to {:.3f}°, but {:.2f}° are needed. Calibrate "
                "with the board in more poses",
                angle_deg, kSureAngle_deg);
  calibration::Calibration better = calibration::corrected(calibration, comparison.correction);
  better.history.checks.push_back(session::checked_now(true, arguments.note));
  if (auto written = io::write_calibration(arguments.corrected, better); !written) return written;
  print_out("wrote {}\n", arguments.corrected.string());
  return {};
}

/// Keeps the outcome with the calibration, for reports. That is no reason for the check to fail.
void keep_outcome(const CalibrateCheckArguments& arguments,
                  const calibration::Calibration& calibration,
                  calibration::VerificationOutcome outcome) {
  if (outcome == calibration::VerificationOutcome::kUnclear) return;
  const bool has_passed = outcome == calibration::VerificationOutcome::kValid;
  const auto noted = session::note_check(arguments.calibration, calibration,
                                         session::checked_now(has_passed, arguments.note));
  if (!noted) print_error("flytri: warning: the check is not noted: {}\n", noted.error().message);
}

Result<void> check_against(const CalibrateCheckArguments& arguments,
                           const calibration::Calibration& calibration) {
  const auto reference = io::read_calibration(arguments.against);
  if (!reference) return tl::unexpected(reference.error());
  const auto comparison = calibration::compare_calibrations(calibration, *reference);
  if (!comparison) return tl::unexpected(comparison.error());
  print(*comparison);
  if (!arguments.corrected.empty()) return correct(arguments, calibration, *comparison);
  const auto report = calibration::judge_comparison(*comparison, calibration);
  keep_outcome(arguments, calibration, report.outcome);
  return conclude(report,
                  "the calibrations differ by too much; correct this one with --correct FILE, or "
                  "calibrate again");
}

}  // namespace

Result<void> calibrate_check(const CalibrateCheckArguments& arguments, const Progress& progress) {
  if (!arguments.corrected.empty()) {
    auto replaceable =
        check_replaceable({arguments.corrected, "flytri.calibration"}, arguments.force);
    if (!replaceable) return replaceable;
  }
  const auto calibration = io::read_calibration(arguments.calibration);
  if (!calibration) return tl::unexpected(calibration.error());
  if (!arguments.against.empty()) return check_against(arguments, *calibration);
  const auto poses = arguments.recording.empty() ? take_poses(arguments, *calibration, progress)
                                                 : shots::read_verification_poses(
                                                       arguments.recording, *calibration, progress);
  if (!poses) return tl::unexpected(poses.error());
  const auto report = arguments.sphere_mm > 0.0
                          ? calibration::check_on_sphere(*poses, arguments.sphere_mm, *calibration)
                          : calibration::check_on_plane(*poses, *calibration);
  if (!report) return tl::unexpected(report.error());
  keep_outcome(arguments, *calibration, report->outcome);
  return conclude(
      *report, "the calibration is no longer valid; calibrate again with flytri calibrate --live");
}

}  // namespace flytri::cli
