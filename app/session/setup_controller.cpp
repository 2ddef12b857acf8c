#include "app/session/setup_controller.h"

#include <fmt/chrono.h>

#include <ctime>
#include <utility>

#include "app/session/user_folders.h"

namespace flytri::session {
namespace {

/// In a folder of its own: a setup never replaces a sensor that is calibrated.
std::filesystem::path new_rig_file() {
  return data_folder() / "sensors" /
         fmt::format("{:%Y-%m-%d-%H%M%S}", fmt::localtime(std::time(nullptr))) / "rig.json";
}

}  // namespace

SetupController::SetupController(std::function<setup::SetupMachine()> machine,
                                 SourceController& source, StageController& stages,
                                 BackgroundWork& background, Notices& notices)
    : machine_(std::move(machine)),
      source_(source),
      stages_(stages),
      background_(background),
      notices_(notices) {}

void SetupController::begin() {
  if (run_ != nullptr || is_closing_ || !stages_.may_leave()) return;
  stages_.pause();
  source_.lend(ui::Text::kSensorIsBeingSetUp);
  run_ = std::make_shared<SetupRun>(machine_(), new_rig_file());
}

void SetupController::answer(const ui::AnswerSetup& given) {
  if (run_ != nullptr) run_->answer(given.question, given.index);
}

void SetupController::close(std::function<void()> then) {
  is_closing_ = true;
  background_.run([this, run = std::move(run_), then = std::move(then)]() mutable {
    run.reset();
    return [this, then] {
      is_closing_ = false;
      then();
    };
  });
}

void SetupController::end() {
  if (run_ == nullptr) return;
  close([this] { source_.take_back(); });
}

/// The scans of a case are loaded again, and measured with the new sensor from now on.
void SetupController::change_source(SourceChoice choice) {
  stages_.forget();
  source_.choose(std::move(choice));
  close([this] {
    source_.take_back();
    source_.open();
  });
}

std::optional<std::filesystem::path> SetupController::use() {
  if (run_ == nullptr || !why_not_used().empty()) return std::nullopt;
  const ui::RunningSetup now = run_->state();
  if (now.step != ui::SetupStep::kDone) return std::nullopt;
  SourceChoice choice;
  choice.name = kRigSource;
  choice.path = now.file;
  change_source(std::move(choice));
  return now.file;
}

bool SetupController::use_virtual_sensor() {
  if (run_ != nullptr || is_closing_ || !stages_.may_leave() || !why_not_used().empty())
    return false;
  stages_.pause();
  source_.lend(ui::Text::kSensorIsBeingSetUp);
  change_source({});
  return true;
}

std::string SetupController::why_not_used() const {
  if (stages_.has_unsaved()) return notices_.texts()[ui::Text::kSaveScansFirst];
  return {};
}

ui::SetupState SetupController::state() const {
  ui::SetupState state;
  state.has_rig = source_.choice().is_rig();
  state.why_not_used = why_not_used();
  if (run_ != nullptr) state.running = run_->state();
  return state;
}

}  // namespace flytri::session
