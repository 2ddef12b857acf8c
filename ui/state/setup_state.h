/// @file  The setup of a sensor's cameras and lights, as its panel shows it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flytri::ui {

enum class SetupStep { kWorking, kAsking, kDone, kFailed };
/// For tests: "asking".
[[nodiscard]] std::string_view to_string(SetupStep step);

/// A question to the user.
struct SetupQuestion {
  int number = 0;  ///< an answer to an earlier question does not count
  std::string text;
  std::vector<std::string> answers;
  std::size_t suggested = 0;  ///< index of the answer that setup expects
};

struct RunningSetup {
  SetupStep step = SetupStep::kWorking;
  std::vector<std::string> told;  ///< oldest first
  SetupQuestion question;         ///< of kAsking
  std::string file;               ///< of kDone: the rig.json that was written
  std::string message;            ///< of kFailed: why
};

/// Whether a sensor can be set up, and the running setup.
struct SetupState {
  bool has_rig = false;      ///< the program scans with devices
  std::string why_not_used;  ///< why another sensor cannot be used now; empty: it can
  std::optional<RunningSetup> running;
};

}  // namespace flytri::ui
