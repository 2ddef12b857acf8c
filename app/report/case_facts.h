/// @file  What the report of a scan says, from its case: the same for window and command line.
#pragma once

#include <string>
#include <vector>

#include "app/report/scan_facts.h"
#include "core/base/result.h"

namespace flytri::report {

struct CaseFacts {
  ScanFacts facts;
  std::vector<std::string> damage;  ///< what of the stage could not be read, a line each
};

/// Reads all of a finished stage, which takes seconds if its scan is long.
/// @errors  As CaseFile::load_result and parse_glb; kInconsistent: the stage has changed since its
///          model was made.
[[nodiscard]] Result<CaseFacts> facts_in(io::CaseFile& file, io::ScanStage stage);

}  // namespace flytri::report
