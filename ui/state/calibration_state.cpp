#include "ui/state/calibration_state.h"

namespace flytri::ui {

std::string_view to_string(CalibrationStep step) {
  switch (step) {
    case CalibrationStep::kOpening:
      return "opening";
    case CalibrationStep::kTarget:
      return "target";
    case CalibrationStep::kTaking:
      return "taking";
    case CalibrationStep::kComputing:
      return "computing";
    case CalibrationStep::kRefused:
      return "refused";
    case CalibrationStep::kDone:
      return "done";
    case CalibrationStep::kFailed:
      break;
  }
  return "failed";
}

std::optional<std::size_t> previous_place(const RunningCalibration& running) {
  for (std::size_t i = running.wanted.value_or(running.places.size()); i-- > 0;) {
    if (running.places[i].is_done) return i;
  }
  return std::nullopt;
}

}  // namespace flytri::ui
