#include "tests/support/fake_calibration.h"

#include <fmt/format.h>

#include <cmath>

#include "core/localization/localize.h"
#include "core/localization/outline.h"
#include "hw/shots/simulated_shots.h"
#include "hw/shots/verification_shots.h"

namespace flytri::testing {
namespace {

using ui::CalibrationPlace;
using ui::CalibrationStep;
using ui::RunningCalibration;
using ui::Text;

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
RunningCalibration calibration_until(std::size_t wanted, const ui::Texts& texts) {
  const calibration::CalibrationPlan plan = shots::plan_of(simulated::intraoral_sensor());
  RunningCalibration running;
  running.folder = "/home/clinic/.local/share/flytri/calibrations/2031-05-02-081214";
  running.step = CalibrationStep::kTarget;
  for (const calibration::Placement& placement : calibration::placements_of(plan)) {
    const double z_mm = plan.z_mm[placement.plane];
    running.places.push_back({std::string(texts.translated(to_string(placement.face))),
                              texts.fill<Text::kAtDepth>(fmt::format("{:+.2f}", z_mm)),
                              fmt::format("{:+.1f}", z_mm), placement.plane,
                              static_cast<std::size_t>(placement.face),
                              running.places.size() < wanted});
  }
  if (wanted < running.places.size()) running.wanted = wanted;
  return running;
}

}  // namespace

RunningCalibration waiting_calibration(const ui::Texts& texts) {
  RunningCalibration running = calibration_until(17, texts);
  running.image = seen_plane(calibration::ShotKind::kDots, 0.0);
  running.shots = {
      {texts[Text::kShotDark], true, "", ""},
      {texts[Text::kShotVertical], true, texts.fill<Text::kFoundAndBrightness>(9, 41.0), ""},
      {texts[Text::kShotHorizontal], true, texts.fill<Text::kFoundAndBrightness>(7, 43.0), ""},
      {texts[Text::kShotVerticalAgain], true, texts.fill<Text::kFoundAndBrightness>(9, 41.0), ""}};
  return running;
}

RunningCalibration refused_shot(const ui::Texts& texts) {
  RunningCalibration running = calibration_until(8, texts);
  running.image = seen_plane(calibration::ShotKind::kVertical, -4.0);
  running.shots = {
      {texts[Text::kShotDark], true, "", ""},
      {texts[Text::kShotVertical], false, "the plane seems to be 0.41 mm farther than z = -4.00 mm",
       texts[Text::kRemedyWrongDepth]}};
  return running;
}

RunningCalibration refused_set(const ui::Texts& texts) {
  RunningCalibration running = calibration_until(34, texts);
  running.step = CalibrationStep::kRefused;
  running.image = seen_plane(calibration::ShotKind::kDots, 8.0);
  running.message =
      "plane 12 (z +3.00 mm) does not fit the others: it is 62 µm off under both patterns; it did "
      "not stand there. Take it again";
  return running;
}

RunningCalibration finished_calibration(const ui::Texts& texts) {
  RunningCalibration running = calibration_until(34, texts);
  running.step = CalibrationStep::kDone;
  running.outcome.is_good = true;
  running.outcome.verdict = texts[Text::kSensorIsCalibrated];
  running.outcome.plane_limit_mm = 0.015;
  for (const double z_mm : shots::plan_of(simulated::intraoral_sensor()).z_mm) {
    running.outcome.planes.push_back({z_mm,
                                      {0.004 * std::sin(1.3 * z_mm), 0.003 * std::cos(1.9 * z_mm)},
                                      {0.02, 0.02},
                                      {60000, 60000}});
  }
  running.outcome.meanings = {texts.fill<Text::kScatter>(19.8, 20.4, 4.0),
                              texts.fill<Text::kWrittenFile>(running.folder + "/calibration.json")};
  return running;
}

RunningCalibration broken_check(const ui::Texts& texts) {
  RunningCalibration running;
  running.task = ui::CalibrationTask::kCheckOnPlane;
  running.step = CalibrationStep::kDone;
  for (std::size_t i = 0; i < shots::verification_places().size(); ++i) {
    running.places.push_back({texts[Text::kTargetPlane],
                              std::string(texts.translated(shots::verification_places()[i].words)),
                              fmt::format("{}", i + 1), i, 0, true});
  }
  running.outcome.verdict = texts[Text::kCalibrationInvalid];
  running.outcome.figures = {
      {calibration::VerificationSymptom::kOffset, "vertical minus horizontal", 0.0412, 0.001,
       0.0211},
      {calibration::VerificationSymptom::kOffsetInDepth, "... near to far", 0.0034, 0.001, 0.0208},
      {calibration::VerificationSymptom::kTiltAlongX, "... left to right", -0.0021, 0.001, 0.0203},
      {calibration::VerificationSymptom::kTiltAlongY, "... top to bottom", 0.0107, 0.001, 0.0203},
      {calibration::VerificationSymptom::kBend, "bend left to right", -0.0042, 0.001, 0.0194}};
  running.outcome.meanings = {texts[Text::kMeansOffset], texts[Text::kCalibrateAgain]};
  return running;
}

}  // namespace flytri::testing
