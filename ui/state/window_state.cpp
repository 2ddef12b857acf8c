#include "ui/state/window_state.h"

#include <charconv>

namespace flytri::ui {

std::string_view to_string(Tool tool) {
  switch (tool) {
    case Tool::kTrim:
      return "trim";
    case Tool::kLock:
      return "lock";
    case Tool::kUnlock:
      return "unlock";
    case Tool::kMeasure:
      return "measure";
    case Tool::kPlane:
      return "plane";
    case Tool::kNone:
      break;
  }
  return "none";
}

std::string_view to_string(Dialog dialog) {
  switch (dialog) {
    case Dialog::kHelp:
      return "help";
    case Dialog::kExport:
      return "export";
    case Dialog::kCase:
      return "case";
    case Dialog::kSettings:
      return "settings";
    case Dialog::kDevices:
      return "devices";
    case Dialog::kCalibration:
      return "calibration";
    case Dialog::kSetup:
      return "setup";
    case Dialog::kQuestion:
      return "question";
    case Dialog::kStages:
      return "stages";
    case Dialog::kNone:
      break;
  }
  return "none";
}

std::string_view to_string(ColorMode mode) {
  switch (mode) {
    case ColorMode::kTexture:
      return "texture";
    case ColorMode::kCoverage:
      return "coverage";
    case ColorMode::kUncertainty:
      return "uncertainty";
    case ColorMode::kClearance:
      return "clearance";
    case ColorMode::kUndercut:
      return "undercut";
    case ColorMode::kShading:
      break;
  }
  return "shading";
}

std::string_view to_string(ReviewMode mode) {
  switch (mode) {
    case ReviewMode::kAngle:
      return "angle";
    case ReviewMode::kSection:
      return "section";
    case ReviewMode::kUndercut:
      return "undercut";
    case ReviewMode::kMargin:
      return "margin";
    case ReviewMode::kDistance:
      break;
  }
  return "distance";
}

std::optional<double> typed_length_mm(const std::string& text) {
  double length_mm = 0.0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, length_mm);
  if (read.ec != std::errc() || read.ptr != end || !(length_mm > 0.0)) return std::nullopt;
  return length_mm;
}

std::optional<SelectedHole> found_again(const SelectedHole& selected,
                                        std::span<const meshing::BoundaryLoop> holes) {
  // While a hole shrinks or splits, its parts stay within half its width.
  double nearest_mm = selected.width_mm / 2.0;
  std::optional<SelectedHole> found;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const double away_mm = (holes[i].center_mm - selected.center_mm).norm();
    if (away_mm > nearest_mm) continue;
    nearest_mm = away_mm;
    found = {i, holes[i].center_mm, holes[i].width_mm};
  }
  return found;
}

void put_tool_away(WindowState& state) {
  state.tool = Tool::kNone;
  state.brush.stroke.clear();
  state.measured_from_mm.reset();
  state.plane_points_mm.clear();
  state.review.angle_mm.clear();
}

}  // namespace flytri::ui
