#include "ui/state/chosen_path.h"

#include <filesystem>

namespace flytri::ui {
namespace {

constexpr const char* kCaseEnding = ".flytri";

}  // namespace

void take_chosen_path(const AppView& view, WindowState& state) {
  const auto& chosen = view.chooser.chosen;
  if (!chosen || chosen->number <= state.latest_choice) return;
  state.latest_choice = chosen->number;
  switch (chosen->field) {
    case PathField::kCase:
      state.case_form.path = chosen->path;
      state.case_form.discards = false;
      break;
    case PathField::kNewCase:
      state.case_form.path = chosen->path;
      if (std::filesystem::path(chosen->path).extension() != kCaseEnding) {
        state.case_form.path += kCaseEnding;
      }
      state.case_form.is_path_edited = true;
      break;
    case PathField::kExportFolder:
      state.export_form.folder = chosen->path;
      state.export_form.is_folder_edited = true;
      break;
    case PathField::kCalibrationFolder:
      state.calibration_form.folder = chosen->path;
      state.calibration_form.is_edited = true;
      break;
    case PathField::kRecordingFolder:
      state.recording_form.folder = chosen->path;
      state.recording_form.is_edited = true;
      break;
  }
}

}  // namespace flytri::ui
