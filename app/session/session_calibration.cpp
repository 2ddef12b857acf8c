/// @file  What a session does about the calibration of its sensor.
#include "app/session/calibration_files.h"
#include "app/session/session.h"
#include "app/session/user_folders.h"
#include "core/io/calibrations/guided_session_file.h"
#include "hw/shots/open_shots.h"
#include "hw/shots/simulated_shots.h"

namespace flytri::session {
namespace {

/// From what is known of the sensor. One that nothing is known of is taken for the intra-oral
/// sensor of the paper.
calibration::CalibrationPlan plan_for(const calibration::Calibration* known) {
  simulated::SensorModel sensor = simulated::intraoral_sensor();
  if (known != nullptr) sensor.volume = known->volume;
  calibration::CalibrationPlan plan = shots::plan_of(sensor);
  for (const Pattern pattern : kPatterns) {
    if (known == nullptr) break;
    plan.line_counts[static_cast<std::size_t>(pattern)] = known->of(pattern).line_count();
  }
  return plan;
}

Result<std::unique_ptr<CalibrationWork>> begin_work(
    const ui::BeginCalibration& command,
    const std::shared_ptr<const calibration::Calibration>& calibration,
    std::shared_ptr<shots::ShotSource> source) {
  switch (command.task) {
    case ui::CalibrationTask::kCheckOnPlane:
      return check_guided(calibration, std::nullopt, std::move(source));
    case ui::CalibrationTask::kCheckOnSphere:
      return check_guided(calibration, command.sphere_diameter_mm, std::move(source));
    case ui::CalibrationTask::kCalibrate:
      break;
  }
  const auto plan = io::guided_plan_or(plan_for(calibration.get()), command.folder);
  if (!plan) return tl::unexpected(plan.error());
  return calibrate_guided(command.folder, *plan, std::move(source));
}

}  // namespace

void Session::handle(const ui::BeginCalibration& command) {
  if (!calibration_state() || desk_ != nullptr || is_desk_closing_) return;
  const bool checks = command.task != ui::CalibrationTask::kCalibrate;
  if (checks && source_.calibration == nullptr) return;
  if (command.task == ui::CalibrationTask::kCheckOnSphere && !options_.source.rig) return;
  handle(ui::PauseScan{});
  capture_.reset();
  DeskJob job;
  job.task = command.task;
  if (!checks) job.folder = command.folder;
  shots::ShotChoice shots;
  shots.simulated = !options_.source.rig;
  if (options_.source.rig) shots.rig = *options_.source.rig;
  job.open_source = [shots] { return shots::open_shots(shots); };
  job.begin_work = [command,
                    calibration = source_.calibration](std::shared_ptr<shots::ShotSource> source) {
    return begin_work(command, calibration, std::move(source));
  };
  desk_ = std::make_shared<CalibrationDesk>(std::move(job));
}

void Session::handle(const ui::TakeCalibrationImages&) {
  if (desk_ != nullptr) desk_->take();
}

void Session::handle(const ui::RetakeCalibrationPlace& command) {
  if (desk_ != nullptr) desk_->retake(command.index);
}

void Session::close_desk(std::function<void()> then) {
  is_desk_closing_ = true;
  do_in_background([this, desk = std::move(desk_), then = std::move(then)]() mutable {
    desk.reset();
    return [this, then] {
      is_desk_closing_ = false;
      calibration_folder_ = propose_calibration_folder(data_folder() / "calibrations");
      then();
    };
  });
}

void Session::handle(const ui::EndCalibration&) {
  if (desk_ == nullptr) return;
  close_desk([this] {
    if (source_.sensor != nullptr) start_capture();
  });
}

/// Scans that a case holds come back from there with the new calibration.
void Session::handle(const ui::UseCalibration&) {
  if (desk_ == nullptr || !why_calibration_is_not_used().empty()) return;
  const std::filesystem::path folder = desk_->state().folder;
  const auto adopted = adopt_calibration(options_.source, folder / "calibration.json");
  if (!adopted) return notice(ui::Severity::kError, adopted.error().message);
  notice(ui::Severity::kInformation, "In use: " + adopted->string());
  forget_scans();
  source_ = {};
  close_desk([this] { open_chosen_source(); });
}

std::string Session::why_calibration_is_not_used() const {
  if (!options_.source.rig) return "the virtual sensor has its own";
  for (const auto& scan : scans_) {
    if (case_ == nullptr && scan != nullptr && !scan->snapshot()->model.empty())
      return "what is scanned must be kept in a case first";
  }
  return {};
}

std::optional<ui::CalibrationState> Session::calibration_state() const {
  if (options_.source.recording) return std::nullopt;
  ui::CalibrationState state;
  state.folder = calibration_folder_.string();
  state.has_calibration = source_.calibration != nullptr;
  state.is_simulated = !options_.source.rig;
  state.why_not_used = why_calibration_is_not_used();
  if (desk_ != nullptr) state.running = desk_->state();
  return state;
}

}  // namespace flytri::session
