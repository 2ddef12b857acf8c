#include "app/session/session.h"

#include <utility>

#include "app/session/settings_file.h"
#include "core/calibration/record/sensor_size.h"
#include "hw/device/clock.h"

namespace flytri::session {
namespace {

scan::LiveScanOptions with_clock(scan::LiveScanOptions options) {
  options.now_s = device::machine_clock().now_s;
  return options;
}

/// The sensor that was set up, unless the command line asks for another one.
SourceChoice with_known_rig(SourceChoice choice, const ui::Settings& settings) {
  if (!choice.is_virtual() || choice.is_given || settings.rig_file.empty()) return choice;
  choice.name = kRigSource;
  choice.path = settings.rig_file;
  return choice;
}

/// Calls the one of several functions that takes the command.
template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace

Session::Session(SessionOptions options)
    : desktop_language_(options.language),
      settings_(read_settings(settings_path())),
      texts_(ui::chosen_language(settings_.language, desktop_language_)),
      notices_(texts_),
      source_(with_known_rig(std::move(options.source), settings_), background_, notices_,
              [this] {
                if (stages_.is_started()) case_.save_unnamed();
                case_.warn_of_other_calibration();
                stages_.begin();
              }),
      stages_(with_clock(std::move(options.scan)), source_, background_, notices_),
      case_(std::move(options.unnamed_folder), source_, stages_, background_, notices_),
      calibration_(source_, stages_, background_, notices_),
      setup_(std::move(options.machine), source_, stages_, background_, notices_),
      exports_(background_, notices_),
      occlusion_(stages_, background_, notices_),
      plane_(stages_, background_, notices_),
      review_(stages_, background_),
      chooser_(std::move(options.file_chooser), notices_) {
  if (!options.recording.empty()) source_.record_in(options.recording);
  source_.open();
}

Session::~Session() {
  background_.cancel();
  calibration_.stop();
  setup_.stop();
  source_.stop();
  background_.stop();
  case_.close();
}

double Session::now_s() const { return device::machine_clock().now_s(); }

void Session::carry_out(const ui::Command& command) {
  std::visit(
      Overloaded{
          [&](const ui::StartScan&) {
            case_.save_unnamed();
            const bool is_new =
                scan() != nullptr && !stages_.is_started() && scan()->snapshot()->model.empty();
            start(is_new);
          },
          [&](const ui::PauseScan&) { pause(); },
          [&](const ui::ResumeScan&) { start(false); },
          [&](const ui::Finish&) { finish(); },
          [&](const ui::CancelFinish&) { stages_.cancel_finish(); },
          [&](const ui::Undo&) { stages_.undo(); },
          [&](const ui::Redo&) { stages_.redo(); },
          [&](const ui::EditSurface& edit) { stages_.edit(edit); },
          [&](const ui::ClearStage& cleared) { stages_.clear(cleared.stage); },
          [&](const ui::BringBackStage&) { stages_.bring_back(); },
          [&](const ui::CopyStage& copied) { stages_.copy_to(copied.to); },
          [&](const ui::AddMeasurement& added) { stages_.add_measurement(added.measurement); },
          [&](const ui::RemoveMeasurement& removed) { stages_.remove_measurement(removed.index); },
          [&](const ui::FindOcclusalPlane&) { plane_.find(); },
          [&](const ui::SetOcclusalPlane& wanted) { plane_.set(wanted.points); },
          [&](const ui::BeginReview&) { review_.begin(); },
          [&](const ui::MeasureAngle& wanted) { review_.measure_angle(wanted); },
          [&](const ui::RemoveAngle& removed) { review_.remove_angle(removed.index); },
          [&](const ui::CutSection& wanted) { review_.cut(wanted); },
          [&](const ui::FindUndercut& wanted) { review_.find_undercut(wanted); },
          [&](const ui::DrawMargin& wanted) { review_.draw_margin(wanted); },
          [&](const ui::KeepMargin&) { review_.keep_margin(); },
          [&](const ui::RemoveMargin& removed) { review_.remove_margin(removed.index); },
          [&](const ui::ShowCrossed& wanted) { stages_.show_crossed(wanted.are_shown); },
          [&](const ui::ChooseReentry& chosen) { stages_.choose_reentry(chosen.index); },
          [&](const ui::SelectStage& selected) { stages_.select(selected.stage); },
          [&](const ui::NewCase& wanted) { case_.create(wanted); },
          [&](const ui::OpenCase& wanted) { case_.open(wanted); },
          [&](const ui::DiscardCase& wanted) { case_.discard(wanted); },
          [&](const ui::SaveRescueCopy& wanted) { case_.save_rescue_copy(wanted); },
          [&](const ui::SetCaseFields& fields) { case_.set_fields(fields); },
          [&](const ui::SteerHand& steering) { source_.steer(steering); },
          [&](const ui::PointHand& pointing) { source_.point(pointing); },
          [&](const ui::FollowPath& path) { source_.follow_path(path.follows); },
          [&](const ui::TakeSensorAway& taken) { source_.take_away(taken.is_away); },
          [&](const ui::RecordFrames& wanted) { source_.record(wanted); },
          [&](const ui::ChoosePath& wanted) { chooser_.choose(wanted); },
          [&](const ui::CheckDevices&) { source_.check_devices(); },
          [&](const ui::BeginCalibration& begun) { calibration_.begin(begun); },
          [&](const ui::TakeCalibrationImages&) { calibration_.take_images(); },
          [&](const ui::RetakeCalibrationPlace& place) { calibration_.retake(place.index); },
          [&](const ui::UseCalibration&) { calibration_.use(); },
          [&](const ui::EndCalibration&) { calibration_.end(); },
          [&](const ui::BeginSetup&) { setup_.begin(); },
          [&](const ui::AnswerSetup& given) { setup_.answer(given); },
          [&](const ui::UseSetup&) { use_set_up_sensor(); },
          [&](const ui::UseVirtualSensor&) { use_virtual_sensor(); },
          [&](const ui::EndSetup&) { setup_.end(); },
          [&](const ui::Export& wanted) { export_scan(wanted); },
          [&](const ui::PrepareExport&) {
            if (scan() != nullptr) exports_.prepare(scan()->snapshot()->result);
          },
          [&](const ui::OpenExportFolder&) { exports_.open_folder(); },
          [&](const ui::ChangeSettings& changed) { change_settings(changed.settings); },
          [&](const ui::Tell& told) {
            notices_.add(ui::Severity::kWarning,
                         texts_.fill<ui::Text::kUnknownCommand>(told.words));
          },
          [&](const ui::Quit&) { is_closing_ = true; },
      },
      command);
}

/// A recording has been playing since it was opened. A new scan starts it again; a resumed scan
/// only if it is over.
void Session::start(bool is_new) {
  if (is_new || source_.state().has_ended) source_.replay();
  stages_.start();
  finish_ahead();
}

void Session::pause() {
  stages_.pause();
  finish_ahead();
}

void Session::finish_ahead() {
  if (source_.calibration() != nullptr) stages_.finish_ahead(close_holes_mm());
}

void Session::finish() {
  if (source_.calibration() != nullptr) stages_.finish(close_holes_mm());
}

double Session::close_holes_mm() const {
  return settings_.close_holes_mm *
         calibration::line_distance_factor(source_.calibration()->volume.size_mm);
}

void Session::export_scan(const ui::Export& command) {
  if (scan() == nullptr) return;
  if (command.target.all_jaws) {
    std::vector<JawToExport> jaws;
    for (const io::ScanStage stage : io::kScanStages) {
      const StageController::StageModel model = stages_.model_of(stage);
      if (model.is_finished && stage != io::ScanStage::kFace)
        jaws.push_back({stage, model.scan, nullptr});
    }
    if (jaws.empty() || stages_.store() == nullptr) return;
    return exports_.export_jaws(command, std::move(jaws),
                                {stages_.store(), stages_.wait_until_kept()});
  }
  exports_.export_scan(command, scan()->snapshot(), stages_.margins(),
                       {stages_.store(), stages_.wait_until_kept()}, stages_.stage());
}

void Session::change_settings(const ui::Settings& settings) {
  settings_ = settings;
  texts_ = ui::Texts(ui::chosen_language(settings_.language, desktop_language_));
  if (auto written = write_settings(settings_path(), settings_); !written) {
    notices_.add(ui::Severity::kWarning, written.error().message);
  }
}

void Session::keep_rig(const std::string& file) {
  ui::Settings settings = settings_;
  settings.rig_file = file;
  change_settings(settings);
}

void Session::use_set_up_sensor() {
  const auto file = setup_.use();
  if (!file) return;
  keep_rig(file->string());
  notices_.add(ui::Severity::kInformation,
               texts_.fill<ui::Text::kCalibrationInUse>(file->string()));
}

void Session::use_virtual_sensor() {
  if (setup_.use_virtual_sensor()) keep_rig({});
}

ui::AppView Session::view() {
  background_.settle();
  ui::AppView view;
  view.now_s = now_s();
  stages_.show_in(view);
  source_.check_failed_devices();
  source_.relate_hand(view.scan == nullptr ? std::nullopt : view.scan->T_world_sensor);
  if (source_.calibration()) view.volume_mm = source_.calibration()->volume.size_mm;
  view.source = source_.state();
  view.devices = source_.devices_state();
  view.recording = source_.recording_state(view.now_s);
  if (!settings_.recording_folder.empty()) view.recording.folder = settings_.recording_folder;
  view.chooser = chooser_.state();
  calibration_.note_finished_check();
  view.calibration = calibration_.state();
  view.setup = setup_.state();
  view.file = case_.state();
  view.occlusion = occlusion_.state();
  view.plane = plane_.state();
  view.review = review_.state();
  view.settings = settings_;
  view.exports = exports_.state(view);
  view.texts = texts_;
  view.notices = notices_.latest();
  const LightNeed need = light_need(view, window_use_);
  view.source.waits_for_focus = need == LightNeed::kNoFocus && source_.choice().is_rig();
  source_.rest(need == LightNeed::kNotNeeded || view.source.waits_for_focus);
  return view;
}

}  // namespace flytri::session
