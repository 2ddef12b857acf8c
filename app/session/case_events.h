/// @file  Entries for the journal of a case, about what this program does now.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/io/cases/case_journal.h"

namespace flytri::session {

/// With the present time, the user and the host as the system names them, and this program.
[[nodiscard]] io::CaseEvent event_now(io::CaseAction action,
                                      std::optional<io::ScanStage> stage = std::nullopt,
                                      const std::vector<std::filesystem::path>& files = {});

}  // namespace flytri::session
