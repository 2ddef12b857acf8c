/// @file  Turns the lights off when the program ends, even if it crashes or is killed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace flytri::gpio {

/// How to turn the lights off.
struct DarkRequest {
  std::string node;   ///< the chip's device file
  std::string label;  ///< of the chip; if the device file now has another label, it is another chip
  std::vector<unsigned> lines;
  std::vector<int> dark_values;  ///< electrical level of each line when its light is off
};

/// A GPIO line keeps its value when its program releases it or ends: with most chips the light
/// stays on. So a child process waits until this program ends, for any reason (return from main,
/// abort, a signal, SIGKILL), and then sets the lines dark. The child ignores every signal except
/// SIGKILL. It cannot act when it is killed itself, for example with its container, or when the
/// chip, the bus or the power fails: the electronics of the lights must handle these cases.
///
/// The child cannot take lines from a suspended program, which would leave the light on. So the
/// program ignores Ctrl-Z (SIGTSTP) while a guard exists, unless the program has its own handler.
/// SIGSTOP cannot be ignored.
///
/// The child is a fork that only makes a few system calls. It shares the program's memory of this
/// moment; memory that the program changes later exists twice. So start the guard early.
class DarkGuard {
 public:
  /// @errors  kInconsistent: the process cannot be started.
  [[nodiscard]] static Result<std::unique_ptr<DarkGuard>> start(const DarkRequest& order);
  /// Ends the guard process; the lights keep their state.
  ~DarkGuard();
  DarkGuard(const DarkGuard&) = delete;
  DarkGuard& operator=(const DarkGuard&) = delete;

 private:
  DarkGuard(int process, int pipe);
  int process_;
  int pipe_;  // write end; closed by the kernel when this process ends
  bool ignores_stop_ = false;
};

}  // namespace flytri::gpio
