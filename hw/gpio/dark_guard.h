/// @file  Turns lights dark when the program dies, however it dies.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace flytri::gpio {

/// What is to be done when the program is gone.
struct DarkOrder {
  std::string node;   ///< the chip's device file
  std::string label;  ///< the chip's: under another label the node is another chip by now
  std::vector<unsigned> lines;
  std::vector<int> dark_values;  ///< of each line, as it is on the wire
};

/// A line that its holder lets go, or that the kernel takes from a dead one, stays as it is: with
/// most chips the light shines on. So a child process waits for this one's end and then takes the
/// lines and turns them dark: after a return from main, abort, an unhandled signal or SIGKILL. It
/// listens to no signal but SIGKILL. It cannot help when it is killed itself, as by the end of a
/// container, nor when chip, bus or power fail: that is for the electronics of the lights.
///
/// Nor can it take lines from a program that is stopped but lives, and a stopped program would
/// leave the light on. So Ctrl-Z (SIGTSTP) is ignored as long as there is a guard, where nothing
/// else was wanted of it; against SIGSTOP there is no remedy.
///
/// The child is a fork that runs no code but a few system calls. It keeps the memory of this
/// moment: what the program changes later is held twice, so that it is best started early.
class DarkGuard {
 public:
  /// @errors  kInconsistent: no process can be started.
  [[nodiscard]] static Result<std::unique_ptr<DarkGuard>> start(const DarkOrder& order);
  /// Dismisses it: the lights are left as they are.
  ~DarkGuard();
  DarkGuard(const DarkGuard&) = delete;
  DarkGuard& operator=(const DarkGuard&) = delete;

 private:
  DarkGuard(int process, int pipe);
  int process_;
  int pipe_;  // open to be written as long as this process lives
  bool ignores_stop_ = false;
};

}  // namespace flytri::gpio
