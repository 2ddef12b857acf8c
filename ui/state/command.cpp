#include "ui/state/command.h"

#include <array>

namespace flytri::ui {

std::string_view name_of(const Command& command) {
  // In the order of the variant.
  static constexpr std::array<std::string_view, std::variant_size_v<Command>> kNames = {
      "StartScan",
      "PauseScan",
      "Undo",
      "Redo",
      "EditSurface",
      "ShowCrossed",
      "ClearStage",
      "BringBackStage",
      "CopyStage",
      "AddMeasurement",
      "RemoveMeasurement",
      "FindOcclusalPlane",
      "SetOcclusalPlane",
      "BeginReview",
      "MeasureAngle",
      "RemoveAngle",
      "CutSection",
      "FindUndercut",
      "DrawMargin",
      "KeepMargin",
      "RemoveMargin",
      "Finish",
      "CancelFinish",
      "ResumeScan",
      "ChooseReentry",
      "SelectStage",
      "Export",
      "PrepareExport",
      "OpenExportFolder",
      "NewCase",
      "OpenCase",
      "DiscardCase",
      "SaveRescueCopy",
      "SetCaseFields",
      "SteerHand",
      "FollowPath",
      "TakeSensorAway",
      "PointHand",
      "ChangeSettings",
      "RecordFrames",
      "ChoosePath",
      "CheckDevices",
      "BeginCalibration",
      "TakeCalibrationImages",
      "RetakeCalibrationPlace",
      "UseCalibration",
      "EndCalibration",
      "BeginSetup",
      "AnswerSetup",
      "UseSetup",
      "UseVirtualSensor",
      "EndSetup",
      "Tell",
      "Quit"};
  return kNames[command.index()];
}

}  // namespace flytri::ui
