#include "ui/actions/perform.h"

#include <algorithm>
#include <cmath>

#include "ui/state/camera_moves.h"

namespace flytri::ui {
namespace {

constexpr double kMoveShare = 0.03;  ///< of the volume's width, for a press of an arrow
constexpr double kTurn_rad = 0.035;  ///< of the sensor, for a press
/// Of the picture's height: a drag that turns the camera as much as a press does.
constexpr double kDragShare = 0.04;
constexpr double kZoomStep = 1.15;
constexpr double kBlendStep = 0.05;
constexpr double kBrushStep = 1.15;
constexpr double kScaleStep = 0.125;

/// The directions of the arrow keys, in the picture: x right, y down.
Vec2 direction(Action action) {
  switch (action) {
    case Action::kLeft:
    case Action::kTiltLeft:
      return {-1.0, 0.0};
    case Action::kRight:
    case Action::kTiltRight:
      return {1.0, 0.0};
    case Action::kUp:
    case Action::kTiltUp:
      return {0.0, -1.0};
    default:
      return {0.0, 1.0};
  }
}

Export export_asked(const ExportForm& form) {
  return {form.folder, form.name, {form.formats.begin(), form.formats.end()}};
}

Command case_asked(const CaseForm& form) {
  switch (form.tab) {
    case CaseTab::kFields:
      return SetCaseFields{form.fields};
    case CaseTab::kNew:
      return NewCase{form.path, form.passphrase, form.fields};
    case CaseTab::kOpen:
      break;
  }
  return OpenCase{form.path, form.passphrase};
}

/// One action at work.
struct Performance {
  const AppView& view;
  WindowState& state;
  std::vector<Command>& commands;

  void toggle_tool(Tool tool) const {
    state.tool = state.tool == tool ? Tool::kNone : tool;
    state.brush.stroke.clear();
    state.measured_from_mm.reset();
  }
  void toggle_dialog(Dialog dialog) const {
    state.dialog = state.dialog == dialog ? Dialog::kNone : dialog;
  }

  void scan() const {
    const bool is_finished = view.scan != nullptr && view.scan->phase == scan::ScanPhase::kFinished;
    if (is_finished) {
      commands.emplace_back(ResumeScan{});
    } else if (view.is_scanning) {
      commands.emplace_back(PauseScan{});
    } else {
      commands.emplace_back(StartScan{});
    }
  }

  void cancel() const {
    if (state.dialog == Dialog::kCalibration && is_calibrating()) {
      commands.emplace_back(EndCalibration{});
    } else if (state.dialog != Dialog::kNone) {
      state.dialog = Dialog::kNone;
    } else if (state.tool != Tool::kNone) {
      toggle_tool(state.tool);
    } else if (view.scan != nullptr && view.scan->phase == scan::ScanPhase::kFinishing) {
      commands.emplace_back(CancelFinish{});
    } else {
      state.selected_hole.reset();
    }
  }

  void confirm() const {
    if (state.dialog == Dialog::kCalibration) {
      const bool is_done = view.calibration->running->step == CalibrationStep::kDone;
      commands.push_back(is_done ? Command(UseCalibration{}) : Command(TakeCalibrationImages{}));
      return;
    }
    if (state.dialog == Dialog::kExport) {
      // Stays open: it shows what was written.
      commands.emplace_back(export_asked(state.export_form));
      return;
    }
    if (state.dialog == Dialog::kCase) {
      commands.push_back(case_asked(state.case_form));
      state.case_form.passphrase.clear();
      state.case_form.is_asked = true;
      // Stays open until the case is: opening may fail, or ask for a passphrase.
      if (state.case_form.tab != CaseTab::kFields) return;
    }
    state.dialog = Dialog::kNone;
  }

  void next_place() const {
    commands.emplace_back(
        ChooseReentry{(view.scan->chosen_reentry + 1) % view.scan->reentry.size()});
  }

  void scanning(Action action) const {
    switch (action) {
      case Action::kScan:
        return scan();
      case Action::kFinish:
        commands.emplace_back(Finish{});
        return;
      case Action::kNextPlace:
        return next_place();
      case Action::kNextHole:
        return show_next_hole(view, state);
      case Action::kStageUpper:
        commands.emplace_back(SelectStage{io::ScanStage::kUpper});
        return;
      case Action::kStageLower:
        commands.emplace_back(SelectStage{io::ScanStage::kLower});
        return;
      default:
        commands.emplace_back(SelectStage{io::ScanStage::kBite});
    }
  }

  void scale_brush(double factor) const {
    state.brush.radius_share = std::clamp(state.brush.radius_share * factor, 0.01, 0.5);
  }

  void editing(Action action) const {
    switch (action) {
      case Action::kUndo:
        commands.emplace_back(Undo{});
        return;
      case Action::kRedo:
        commands.emplace_back(Redo{});
        return;
      case Action::kTrim:
        return toggle_tool(Tool::kTrim);
      case Action::kLock:
        return toggle_tool(Tool::kLock);
      case Action::kUnlock:
        return toggle_tool(Tool::kUnlock);
      case Action::kMeasure:
        return toggle_tool(Tool::kMeasure);
      case Action::kRemoveMeasurement:
        commands.emplace_back(RemoveMeasurement{view.measurements.size() - 1});
        return;
      case Action::kBrushSmaller:
        return scale_brush(1.0 / kBrushStep);
      default:
        return scale_brush(kBrushStep);
    }
  }

  void blend(double step) const {
    state.texture_blend = std::clamp(state.texture_blend + step, 0.0, 1.0);
  }
  void look_from(StandardView side) const { show_from(side, *view.scan, state.view); }
  void zoom(double factor) const {
    state.view.follows_scan = false;
    state.view.camera.zoom(factor);
  }

  void looking(Action action) const {
    switch (action) {
      case Action::kShading:
        state.color_mode = ColorMode::kShading;
        return;
      case Action::kTexture:
        state.color_mode = ColorMode::kTexture;
        return;
      case Action::kCoverage:
        state.color_mode = ColorMode::kCoverage;
        return;
      case Action::kUncertainty:
        state.color_mode = ColorMode::kUncertainty;
        return;
      case Action::kBlendLess:
        return blend(-kBlendStep);
      case Action::kBlendMore:
        return blend(kBlendStep);
      case Action::kOcclusal:
        return look_from(StandardView::kOcclusal);
      case Action::kBuccal:
        return look_from(StandardView::kBuccal);
      case Action::kLingual:
        return look_from(StandardView::kLingual);
      case Action::kShowAll:
        return look_anew(state.view);
      case Action::kZoomIn:
        return zoom(kZoomStep);
      default:
        return zoom(1.0 / kZoomStep);
    }
  }

  void arrow(const Vec2& towards) const {
    if (view.source.hand && !view.source.hand->follows_path) {
      const Vec2 move_mm = kMoveShare * view.volume_mm.x() * towards;
      commands.emplace_back(SteerHand{{move_mm.x(), move_mm.y(), 0.0}, Vec3::Zero()});
      return;
    }
    state.view.follows_scan = false;
    const Vec2 drag_px = kDragShare * state.view.picture.height_px * towards;
    state.view.camera.orbit(drag_px.x(), drag_px.y(), state.view.picture);
  }

  void hand(Action action) const {
    const double away_mm = kMoveShare * view.volume_mm.z();
    switch (action) {
      case Action::kLeft:
      case Action::kRight:
      case Action::kUp:
      case Action::kDown:
        return arrow(direction(action));
      case Action::kHandMode:
        commands.emplace_back(FollowPath{!view.source.hand->follows_path});
        return;
      case Action::kTakeAway:
        commands.emplace_back(TakeSensorAway{!view.source.hand->is_taken_away});
        return;
      case Action::kHandNearer:
        commands.emplace_back(SteerHand{{0.0, 0.0, away_mm}, Vec3::Zero()});
        return;
      case Action::kHandFarther:
        commands.emplace_back(SteerHand{{0.0, 0.0, -away_mm}, Vec3::Zero()});
        return;
      default:
        const Vec2 towards = direction(action);
        commands.emplace_back(
            SteerHand{Vec3::Zero(), kTurn_rad * Vec3(-towards.y(), towards.x(), 0.0)});
    }
  }

  void change(const Settings& settings) const { commands.emplace_back(ChangeSettings{settings}); }
  void scale(double step) const {
    Settings settings = view.settings;
    settings.user_scale = std::clamp(settings.user_scale + step, 0.75, 2.0);
    change(settings);
  }
  void mute() const {
    Settings settings = view.settings;
    settings.is_muted = !settings.is_muted;
    change(settings);
  }

  [[nodiscard]] bool is_calibrating() const {
    return view.calibration.has_value() && view.calibration->running.has_value();
  }

  void begin_calibration(CalibrationTask task) const {
    const CalibrationForm& form = state.calibration_form;
    commands.emplace_back(BeginCalibration{task,
                                           form.is_edited ? form.folder : view.calibration->folder,
                                           typed_length_mm(form.sphere_diameter_mm).value_or(0.0)});
  }

  void calibrating(Action action) const {
    switch (action) {
      case Action::kCalibration:
        return toggle_dialog(Dialog::kCalibration);
      case Action::kCalibrate:
        return begin_calibration(CalibrationTask::kCalibrate);
      case Action::kCheckOnPlane:
        return begin_calibration(CalibrationTask::kCheckOnPlane);
      case Action::kCheckOnSphere:
        return begin_calibration(CalibrationTask::kCheckOnSphere);
      default:
        commands.emplace_back(RetakeCalibrationPlace{*place_before(*view.calibration->running)});
    }
  }

  void program(Action action) const {
    switch (action) {
      case Action::kExport:
        return toggle_dialog(Dialog::kExport);
      case Action::kCase:
        return toggle_dialog(Dialog::kCase);
      case Action::kSettings:
        return toggle_dialog(Dialog::kSettings);
      case Action::kDevices:
        return toggle_dialog(Dialog::kDevices);
      case Action::kCheckDevices:
        commands.emplace_back(CheckDevices{});
        return;
      case Action::kHelp:
        return toggle_dialog(Dialog::kHelp);
      case Action::kMute:
        return mute();
      case Action::kLarger:
        return scale(kScaleStep);
      case Action::kSmaller:
        return scale(-kScaleStep);
      case Action::kConfirm:
        return confirm();
      case Action::kCancel:
        return cancel();
      default:
        commands.emplace_back(Quit{});
    }
  }
};

}  // namespace

void perform(Action action, const AppView& view, WindowState& state,
             std::vector<Command>& commands) {
  if (!action_state(action, view, state).is_enabled) return;
  const Performance performance{view, state, commands};
  switch (binding(action).group) {
    case ActionGroup::kScanning:
      return performance.scanning(action);
    case ActionGroup::kEditing:
      return performance.editing(action);
    case ActionGroup::kLooking:
      return performance.looking(action);
    case ActionGroup::kHand:
      return performance.hand(action);
    case ActionGroup::kCalibrating:
      return performance.calibrating(action);
    case ActionGroup::kProgram:
      return performance.program(action);
  }
}

}  // namespace flytri::ui
