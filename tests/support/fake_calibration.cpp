#include "tests/support/fake_calibration.h"

#include <fmt/format.h>

#include <cmath>

#include "core/calibration/guide/shot_verdict.h"
#include "core/localization/localize.h"
#include "core/localization/outline.h"
#include "hw/shots/simulated_shots.h"
#include "hw/shots/verification_shots.h"

namespace flytri::testing {
namespace {

using ui::CalibrationPlace;
using ui::CalibrationStep;
using ui::RunningCalibration;

std::shared_ptr<const scan::LiveFrame> seen_plane(calibration::ShotKind kind, double z_mm) {
  const auto shots = shots::SimulatedShots::create(simulated::intraoral_sensor()).value();
  auto seen = std::make_shared<scan::LiveFrame>();
  seen->frame.image = shots->take(kind, z_mm, {}).value();
  if (kind != calibration::ShotKind::kVertical) return seen;
  seen->frame.kind = FrameKind::kVertical;
  const auto traces =
      localization::localize_lines(seen->frame.image, Pattern::kVertical, {}).value();
  for (const localization::LineTrace& trace : traces) {
    seen->lines.push_back(localization::outline_of(trace, Pattern::kVertical));
  }
  return seen;
}

/// The order of placements is: both targets at one depth, then the next depth.
RunningCalibration calibration_until(std::size_t wanted) {
  const calibration::CalibrationPlan plan = shots::plan_of(simulated::intraoral_sensor());
  RunningCalibration running;
  running.folder = "/home/clinic/.local/share/flytri/calibrations/2031-05-02-081214";
  running.step = CalibrationStep::kTarget;
  for (const calibration::Placement& placement : calibration::placements_of(plan)) {
    const double z_mm = plan.z_mm[placement.plane];
    running.places.push_back({std::string(to_string(placement.face)),
                              fmt::format("at z = {:+.2f} mm", z_mm), fmt::format("{:+.1f}", z_mm),
                              placement.plane, static_cast<std::size_t>(placement.face),
                              running.places.size() < wanted});
  }
  if (wanted < running.places.size()) running.wanted = wanted;
  return running;
}

}  // namespace

RunningCalibration waiting_calibration() {
  RunningCalibration running = calibration_until(17);
  running.image = seen_plane(calibration::ShotKind::kDots, 0.0);
  running.shots = {{"dark", true, "", ""},
                   {"vertical lines", true, "9 found, brightness 41 %", ""},
                   {"horizontal lines", true, "7 found, brightness 43 %", ""},
                   {"vertical lines again", true, "9 found, brightness 41 %", ""}};
  return running;
}

RunningCalibration refused_shot() {
  RunningCalibration running = calibration_until(8);
  running.image = seen_plane(calibration::ShotKind::kVertical, -4.0);
  running.shots = {
      {"dark", true, "", ""},
      {"vertical lines", false, "the plane seems to be 0.41 mm farther than z = -4.00 mm",
       std::string(calibration::remedy_of(calibration::ShotFault::kWrongDepth))}};
  return running;
}

RunningCalibration refused_set() {
  RunningCalibration running = calibration_until(34);
  running.step = CalibrationStep::kRefused;
  running.image = seen_plane(calibration::ShotKind::kDots, 8.0);
  running.message =
      "plane 12 (z +3.00 mm) does not fit the others: it is 62 µm off under both patterns; it did "
      "not stand there. Take it again";
  return running;
}

RunningCalibration finished_calibration() {
  RunningCalibration running = calibration_until(34);
  running.step = CalibrationStep::kDone;
  running.outcome.is_good = true;
  running.outcome.verdict = "The sensor is calibrated";
  running.outcome.plane_limit_mm = 0.015;
  for (const double z_mm : shots::plan_of(simulated::intraoral_sensor()).z_mm) {
    running.outcome.planes.push_back({z_mm,
                                      {0.004 * std::sin(1.3 * z_mm), 0.003 * std::cos(1.9 * z_mm)},
                                      {0.02, 0.02},
                                      {60000, 60000}});
  }
  running.outcome.meanings = {
      "Single samples scatter by 19.8 \u00b5m on vertical and 20.4 \u00b5m on horizontal lines; no "
      "plane is farther than 4.0 \u00b5m from its place.",
      "Written: " + running.folder + "/calibration.json"};
  return running;
}

RunningCalibration broken_check() {
  RunningCalibration running;
  running.task = ui::CalibrationTask::kCheckOnPlane;
  running.step = CalibrationStep::kDone;
  for (std::size_t i = 0; i < shots::verification_places().size(); ++i) {
    running.places.push_back({"plane", std::string(shots::verification_places()[i].words),
                              fmt::format("{}", i + 1), i, 0, true});
  }
  running.outcome.verdict = "The calibration no longer holds";
  running.outcome.figures = {
      {calibration::VerificationSymptom::kOffset, "vertical minus horizontal", 0.0412, 0.001,
       0.0211},
      {calibration::VerificationSymptom::kOffsetInDepth, "... from near to far", 0.0034, 0.001,
       0.0208},
      {calibration::VerificationSymptom::kTiltAlongX, "... from left to right", -0.0021, 0.001,
       0.0203},
      {calibration::VerificationSymptom::kTiltAlongY, "... from top to bottom", 0.0107, 0.001,
       0.0203},
      {calibration::VerificationSymptom::kBend, "both bend", -0.0042, 0.001, 0.0194}};
  running.outcome.meanings = {"A projector or the camera turned or moved across its lines.",
                              "Calibrate the sensor anew."};
  return running;
}

}  // namespace flytri::testing
