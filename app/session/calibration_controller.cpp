#include "app/session/calibration_controller.h"

#include <utility>

#include "app/session/calibration_files.h"
#include "app/session/user_folders.h"
#include "core/io/calibrations/guided_session_file.h"
#include "hw/shots/open_shots.h"
#include "hw/shots/simulated_shots.h"

namespace flytri::session {
namespace {

/// The plan for a sensor with this calibration. Null: for the intra-oral sensor of the paper.
calibration::CalibrationPlan plan_for(const calibration::Calibration* known, bool has_texture) {
  simulated::SensorModel sensor = simulated::intraoral_sensor();
  if (known != nullptr) sensor.volume = known->volume;
  calibration::CalibrationPlan plan = shots::plan_of(sensor);
  plan.has_texture = has_texture;
  for (const Pattern pattern : kPatterns) {
    if (known == nullptr) break;
    plan.line_counts[static_cast<std::size_t>(pattern)] = known->of(pattern).line_count();
  }
  return plan;
}

Result<std::unique_ptr<CalibrationWork>> begin_work(
    const ui::BeginCalibration& command,
    const std::shared_ptr<const calibration::Calibration>& calibration,
    std::shared_ptr<shots::ShotSource> source, const ui::Texts& texts) {
  switch (command.task) {
    case ui::CalibrationTask::kCheckOnPlane:
      return check_guided(calibration, std::nullopt, std::move(source), texts);
    case ui::CalibrationTask::kCheckOnSphere:
      return check_guided(calibration, command.sphere_diameter_mm, std::move(source), texts);
    case ui::CalibrationTask::kCalibrate:
      break;
  }
  const auto plan =
      io::guided_plan_or(plan_for(calibration.get(), source->has_texture()), command.folder);
  if (!plan) return tl::unexpected(plan.error());
  return calibrate_guided(command, *plan, std::move(source), texts);
}

std::filesystem::path propose_folder() {
  return propose_calibration_folder(data_folder() / "calibrations");
}

}  // namespace

CalibrationController::CalibrationController(SourceController& source, StageController& stages,
                                             BackgroundWork& background, Notices& notices)
    : source_(source),
      stages_(stages),
      background_(background),
      notices_(notices),
      proposed_folder_(propose_folder()) {}

void CalibrationController::begin(const ui::BeginCalibration& command) {
  if (!state() || run_ != nullptr || is_closing_ || !stages_.may_leave()) return;
  const bool has_rig = source_.choice().is_rig();
  const bool checks = command.task != ui::CalibrationTask::kCalibrate;
  if (checks && source_.calibration() == nullptr) return;
  if (command.task == ui::CalibrationTask::kCheckOnSphere && !has_rig) return;
  stages_.pause();
  source_.lend(ui::Text::kSensorIsBeingCalibrated);
  CalibrationJob job;
  job.task = command.task;
  if (!checks) job.folder = command.folder;
  shots::ShotChoice shots;
  shots.simulated = !has_rig;
  if (has_rig) shots.rig = source_.choice().path;
  job.open_source = [shots] { return shots::open_shots(shots); };
  job.begin_work = [command, calibration = source_.calibration(),
                    texts = notices_.texts()](std::shared_ptr<shots::ShotSource> source) {
    return begin_work(command, calibration, std::move(source), texts);
  };
  checked_ = checks ? source_.calibration() : nullptr;
  note_ = command.note;
  run_ = std::make_shared<CalibrationRun>(std::move(job));
}

void CalibrationController::note_finished_check() {
  if (run_ == nullptr || checked_ == nullptr) return;
  const ui::RunningCalibration now = run_->state();
  if (now.step != ui::CalibrationStep::kDone) return;
  const auto checked = std::exchange(checked_, nullptr);
  if (!now.outcome.has_passed) return;
  const auto check = checked_now(*now.outcome.has_passed, note_);
  source_.note_check(*checked, check);
  background_.run(
      [this, file = source_.source().calibration_file, store = stages_.store(), checked, check] {
        auto noted = std::make_shared<Result<void>>(session::note_check(file, *checked, check));
        if (store != nullptr) {
          if (auto kept = store->note_check(*checked, check); *noted && !kept) *noted = kept;
        }
        return [this, noted, file] {
          const ui::Texts& texts = notices_.texts();
          if (*noted) {
            return notices_.add(ui::Severity::kInformation,
                                texts.fill<ui::Text::kCheckNoted>(file.string()));
          }
          notices_.add(ui::Severity::kWarning,
                       texts.fill<ui::Text::kCheckNotNoted>(noted->error().message));
        };
      });
}

void CalibrationController::take_images() {
  if (run_ != nullptr) run_->take();
}

void CalibrationController::retake(std::size_t place) {
  if (run_ != nullptr) run_->retake(place);
}

void CalibrationController::close(std::function<void()> then) {
  is_closing_ = true;
  background_.run([this, run = std::move(run_), then = std::move(then)]() mutable {
    run.reset();
    return [this, then] {
      is_closing_ = false;
      proposed_folder_ = propose_folder();
      then();
    };
  });
}

void CalibrationController::end() {
  if (run_ == nullptr) return;
  close([this] { source_.take_back(); });
}

/// The scans of a case are loaded again, and measured with the new calibration from now on.
void CalibrationController::use() {
  if (run_ == nullptr || !why_not_used().empty()) return;
  const std::filesystem::path folder = run_->state().folder;
  const auto adopted = adopt_calibration(source_.choice(), folder / "calibration.json");
  if (!adopted) return notices_.add(ui::Severity::kError, adopted.error().message);
  notices_.add(ui::Severity::kInformation,
               notices_.texts().fill<ui::Text::kCalibrationInUse>(adopted->string()));
  stages_.forget();
  source_.forget();
  close([this] {
    source_.take_back();
    source_.open();
  });
}

std::string CalibrationController::why_not_used() const {
  if (source_.choice().is_virtual()) return notices_.texts()[ui::Text::kVirtualHasItsOwn];
  if (stages_.has_unsaved()) return notices_.texts()[ui::Text::kSaveScansFirst];
  return {};
}

std::optional<ui::CalibrationState> CalibrationController::state() const {
  if (!source_.choice().is_rig() && !source_.choice().is_virtual()) return std::nullopt;
  ui::CalibrationState state;
  state.folder = proposed_folder_.string();
  state.calibration = source_.calibration();
  state.is_simulated = source_.choice().is_virtual();
  state.why_not_used = why_not_used();
  if (run_ != nullptr) state.running = run_->state();
  return state;
}

}  // namespace flytri::session
