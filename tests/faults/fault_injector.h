/// @file  Runs work in a child process in which one system call fails, or that is killed before
/// one.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "tests/support/temporary_folder.h"

namespace flytri::testing {

/// One system call of a run that does not do what it should.
struct Fault {
  std::string call;    ///< "fsync"
  std::string effect;  ///< as strace has it: "error=EIO", "signal=KILL"
  int number = 0;      ///< which of the calls of that name, from 1
  [[nodiscard]] bool kills() const { return effect == "signal=KILL"; }
};

/// How a run ended.
struct RunEnd {
  bool is_done = false;    ///< the work returned without an error
  bool is_killed = false;  ///< by SIGKILL
  std::string message;     ///< of the error
  std::string trouble;     ///< neither of these: a crash, an exception, or strace did not work
};

using FaultyWork = std::function<Result<void>()>;

/// Why faults cannot be injected here; empty: they can.
[[nodiscard]] std::string why_no_faults();

/// How often the work makes each of the calls that can fail when it writes.
[[nodiscard]] std::map<std::string, int> count_calls(const FaultyWork& work);

[[nodiscard]] RunEnd run_with(const Fault& fault, const FaultyWork& work);

/// An operation that writes files.
struct FaultyOperation {
  std::function<void(const std::filesystem::path& folder)> prepare;
  std::function<Result<void>(const std::filesystem::path& folder)> work;
  /// Checks what is in the folder after the run.
  std::function<void(const std::filesystem::path& folder, const RunEnd& end)> check;
};

/// Runs the operation with each fault, in a new folder each time: every call once full, once
/// failing, once killed before it. Also checks that an error names a file in the folder, and that
/// nothing temporary is left. FLYTRI_FAULT_STEP=n takes only every n-th call.
void expect_withstands_faults(const FaultyOperation& operation);

}  // namespace flytri::testing
