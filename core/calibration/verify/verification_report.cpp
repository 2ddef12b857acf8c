#include "core/calibration/verify/verification_report.h"

#include <algorithm>

#include "core/base/check_options.h"

namespace flytri::calibration {
namespace {

bool shows(const VerificationReport& report, VerificationSymptom symptom) {
  return std::any_of(report.figures.begin(), report.figures.end(),
                     [&](const VerificationFigure& figure) {
                       return figure.symptom == symptom && !figure.good();
                     });
}

/// A rotated line pattern has errors along its lines: from top to bottom for vertical lines, from
/// left to right for horizontal ones. A rolled camera rotates both.
std::string meaning_of_tilt(bool along_x, bool along_y) {
  if (along_x && along_y) {
    return "The difference between the patterns changes from left to right and from top to bottom: "
           "the camera has rolled about its axis, or both projectors have.";
  }
  return along_y ? "The difference between the patterns changes from top to bottom: the vertical "
                   "projector has rolled about its axis, or the horizontal projector has moved "
                   "along its axis."
                 : "The difference between the patterns changes from left to right: the horizontal "
                   "projector has rolled about its axis, or the vertical projector has moved along "
                   "its axis.";
}

std::vector<std::string> meanings_of(const VerificationReport& report) {
  using enum VerificationSymptom;
  std::vector<std::string> meanings;
  if (shows(report, kOffset) || shows(report, kOffsetInDepth)) {
    meanings.emplace_back(
        "Vertical and horizontal lines measure different depths: a projector or the camera has "
        "turned or moved across its lines.");
  }
  const bool along_x = shows(report, kTiltAlongX), along_y = shows(report, kTiltAlongY);
  if (along_x || along_y) meanings.push_back(meaning_of_tilt(along_x, along_y));
  if (shows(report, kMagnification)) {
    meanings.emplace_back(
        "The image has another scale: the camera has moved along its axis, or its lens was "
        "refocused.");
  }
  if (shows(report, kOwnBend)) {
    meanings.emplace_back(
        "The two patterns measure a different curvature: a projector's lens was moved or "
        "refocused.");
  }
  if (shows(report, kBend)) {
    meanings.emplace_back(
        "A flat surface is measured as curved: the camera's lens was moved or refocused, or the "
        "camera has moved.");
  }
  if (shows(report, kDiameter)) {
    meanings.emplace_back(
        "Measured sizes are wrong: the camera has moved along its axis, or its lens was "
        "refocused.");
  }
  if (shows(report, kShear)) {
    meanings.emplace_back(
        "The stage did not move at right angles to the target when the sensor was calibrated: a "
        "sphere is measured as a leaning egg. Calibrate with a board that is held by hand; it "
        "needs no stage, and flytri calibrate --check --against BOARD.json --correct FILE "
        "corrects this calibration.");
  }
  if (shows(report, kScale)) {
    meanings.emplace_back(
        "Distances are too long or too short: the pitch of the target's dots or the step of the "
        "stage is not as told. Measure the printed target and the board with a caliper.");
  }
  if (shows(report, kForm)) {
    meanings.emplace_back(
        "Points scatter more than expected from noise: lenses are dirty or out of focus, or the "
        "object is not smooth enough.");
  }
  return meanings;
}

}  // namespace

Result<void> VerificationOptions::validate() const {
  return OptionCheck("VerificationOptions")
      .positive("residual_factor", residual_factor)
      .positive("noise_factor", noise_factor)
      .in_range("min_extent_share", min_extent_share, 0.0, 1.0)
      .in_range("min_share_on_object", min_share_on_object, 0.0, 1.0)
      .in_range("max_limit_share", max_limit_share, 0.0, 1.0)
      .result();
}

std::string_view to_string(VerificationOutcome outcome) {
  switch (outcome) {
    case VerificationOutcome::kValid:
      return "valid";
    case VerificationOutcome::kBroken:
      return "no longer valid";
    case VerificationOutcome::kUnclear:
      return "unclear";
  }
  return "";
}

void judge(VerificationReport& report, const MeasurementVolume& volume,
           const VerificationOptions& options) {
  const double max_limit_mm = options.max_limit_share * volume.size_mm.z();
  const bool is_broken =
      std::any_of(report.figures.begin(), report.figures.end(),
                  [](const VerificationFigure& figure) { return !figure.good(); });
  if (is_broken) {
    report.outcome = VerificationOutcome::kBroken;
    report.meanings = meanings_of(report);
    return;
  }
  for (const VerificationFigure& figure : report.figures) {
    if (figure.uncertainty_mm == 0.0 || figure.limit_mm <= max_limit_mm) continue;
    report.outcome = VerificationOutcome::kUnclear;
    report.reason = fmt::format(
        "the uncertainty of {} is {:.0f} µm, too large; show the object at more places, or move it "
        "more slowly",
        figure.name, 1e3 * figure.uncertainty_mm);
    return;
  }
  report.outcome = VerificationOutcome::kValid;
}

}  // namespace flytri::calibration
