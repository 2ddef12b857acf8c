/// @file  Carries out one setup of a sensor on its own thread, and waits there for answers.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/task_thread.h"
#include "hw/setup/setup_machine.h"
#include "ui/state/setup_state.h"

namespace flytri::session {

/// Starts at once. The destructor stops it; after that the lights are off and the devices free.
class SetupRun final : private setup::SetupTalk {
 public:
  /// @param file  the rig.json to write, in a folder of its own, which gives the rig its name
  SetupRun(setup::SetupMachine machine, std::filesystem::path file);
  ~SetupRun() override;

  /// Does nothing unless this question is asked now and has such an answer.
  void answer(int question, std::size_t index);

  [[nodiscard]] ui::RunningSetup state() const;

 private:
  // On the run's thread.
  void run();
  [[nodiscard]] Result<void> set_up();
  void tell(const std::string& text) override;
  [[nodiscard]] std::optional<std::size_t> choose(const std::string& question,
                                                  const std::vector<std::string>& answers,
                                                  std::size_t suggested) override;

  const setup::SetupMachine machine_;
  const std::filesystem::path file_;
  const Progress progress_;

  mutable std::mutex mutex_;
  std::condition_variable answered_;
  ui::RunningSetup state_;
  std::optional<std::size_t> answer_;

  TaskThread thread_;  ///< destroyed first: its task uses the members above
};

}  // namespace flytri::session
