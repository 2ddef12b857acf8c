/// @file  The journal of a case: who did what with it, and when. Entries are added, never changed.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/cases/case_file.h"

namespace flytri::io {

enum class CaseAction {
  kCreated,
  kOpened,          ///< to scan, or to save a model in it
  kOpenedReadOnly,  ///< only read
  kExported,        ///< models were written to files
  kComputed,        ///< a model was made of a stage, and saved in the case
  kMoved,           ///< got this file, for instance when an unnamed scan was named
  kCopied,          ///< a stage was started as a copy of another one
};
inline constexpr std::array kCaseActions = {
    CaseAction::kCreated,  CaseAction::kOpened, CaseAction::kOpenedReadOnly, CaseAction::kExported,
    CaseAction::kComputed, CaseAction::kMoved,  CaseAction::kCopied};
/// "created", "opened", "opened read-only", "exported", "computed", "moved", "copied".
[[nodiscard]] std::string_view to_string(CaseAction action);

/// An entry of the journal.
struct CaseEvent {
  CaseAction action = CaseAction::kOpened;
  std::string time;                ///< ISO 8601, UTC
  std::string user, host;          ///< as the system says
  std::string program;             ///< with its version: "flytri 0.1.0"
  std::optional<ScanStage> stage;  ///< of what was exported, computed or started
  std::vector<std::string> files;  ///< paths that were written; their extensions say the formats
  std::optional<ScanStage> from = std::nullopt;  ///< the stage that was copied
  bool operator==(const CaseEvent&) const = default;
};

/// The entries, the oldest first.
struct CaseJournal {
  std::vector<CaseEvent> events;
  std::vector<std::string> damage;  ///< what could not be read
};

}  // namespace flytri::io
