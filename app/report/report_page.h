/// @file  The report of a scan as a page that opens without a network.
#pragma once

#include <string>

#include "app/report/scan_facts.h"
#include "core/base/result.h"

namespace flytri::report {

/// One page, HTML, for A4: a picture of the jaw colored by uncertainty, then distances, coverage,
/// holes, calibration and edits.
/// @errors  As io::encode_png.
[[nodiscard]] Result<std::string> report_page(const ScanFacts& facts);

}  // namespace flytri::report
