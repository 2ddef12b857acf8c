/// @file  Turns the lights off when the program ends, even if it crashes or is killed, and when it
/// leaves a light on for too long.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "hw/device/light_limits.h"

namespace flytri::gpio {

/// How to turn the lights off, and when.
struct DarkRequest {
  /// The kernel's file of the program's own request for the lines. The guard shares it, so that it
  /// can set the lines while the program holds them.
  int held_lines = -1;
  std::string node;   ///< the chip's device file
  std::string label;  ///< of the chip; if the device file now has another label, it is another chip
  std::vector<unsigned> lines;
  std::vector<int> dark_values;  ///< electrical level of each line when its light is off
  device::LightLimits limits;
};

/// A GPIO line keeps its value when its program releases it or ends: with most chips the light
/// stays on. So a child process waits until this program ends, for any reason (return from main,
/// abort, a signal, SIGKILL), and then sets the lines dark. The child ignores every signal except
/// SIGKILL. It cannot act when it is killed itself, for example with its container, or when the
/// chip, the bus or the power fails: the electronics of the lights must handle these cases.
///
/// The program tells the child when a light goes on. The child measures the time itself, and turns
/// the lights off at a limit, even if the program hangs or is suspended (SIGSTOP, a debugger).
///
/// The program ignores Ctrl-Z (SIGTSTP) while a guard exists, unless the program has its own
/// handler: a suspended scan is of no use.
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

  /// Call it before the device is told to turn on `light`. Does not wait.
  /// @return  0; or the errno if the guard does not take the message: then leave the light off
  [[nodiscard]] int begin(device::Light light);
  /// Call it when the device was told: only `light` is on.
  /// @return  as begin()
  [[nodiscard]] int finish(device::Light light);

 private:
  DarkGuard(int process, int socket);
  int process_;
  int socket_;  // closed by the kernel when this process ends
  bool ignores_stop_ = false;
};

}  // namespace flytri::gpio
