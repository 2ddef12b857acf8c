#include "app/session/setup_run.h"

#include <fmt/format.h>

#include <utility>

#include "core/io/files/file_bytes.h"
#include "hw/rig/rig_file.h"
#include "hw/setup/run_setup.h"

namespace flytri::session {

SetupRun::SetupRun(setup::SetupMachine machine, std::filesystem::path file)
    : machine_(std::move(machine)), file_(std::move(file)) {
  thread_.post([this] { run(); });
}

SetupRun::~SetupRun() {
  {
    const std::lock_guard lock(mutex_);
    progress_.cancel();
  }
  answered_.notify_all();
  thread_.stop();
}

ui::RunningSetup SetupRun::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void SetupRun::answer(int question, std::size_t index) {
  {
    const std::lock_guard lock(mutex_);
    const ui::SetupQuestion& asked = state_.question;
    if (state_.step != ui::SetupStep::kAsking || question != asked.number) return;
    if (index >= asked.answers.size()) return;
    answer_ = index;
    state_.step = ui::SetupStep::kWorking;
  }
  answered_.notify_all();
}

void SetupRun::run() {
  const auto done = set_up();
  const std::lock_guard lock(mutex_);
  if (done) {
    state_.file = file_.string();
    state_.step = ui::SetupStep::kDone;
  } else {
    state_.message = done.error().message;
    state_.step = ui::SetupStep::kFailed;
  }
}

Result<void> SetupRun::set_up() {
  const std::filesystem::path folder = file_.parent_path();
  const auto rig = setup::run_setup(folder.filename().string(), {machine_, *this, progress_});
  if (!rig) return tl::unexpected(rig.error());
  if (auto made = io::create_folder(folder); !made) return made;
  return rig::write_rig(file_, *rig);
}

void SetupRun::tell(const std::string& text) {
  const std::lock_guard lock(mutex_);
  state_.told.push_back(text);
}

std::optional<std::size_t> SetupRun::choose(const std::string& question,
                                            const std::vector<std::string>& answers,
                                            std::size_t suggested) {
  std::unique_lock lock(mutex_);
  state_.question = {state_.question.number + 1, question, answers, suggested};
  state_.step = ui::SetupStep::kAsking;
  answer_.reset();
  answered_.wait(lock, [this] { return answer_ || progress_.cancelled(); });
  state_.step = ui::SetupStep::kWorking;
  if (!answer_) return std::nullopt;
  state_.told.push_back(fmt::format("{} {}", question, answers[*answer_]));
  return answer_;
}

}  // namespace flytri::session
