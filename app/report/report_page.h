/// @file  The report of a scan as a page that opens without a network.
#pragma once

#include <string>

#include "app/report/scan_facts.h"
#include "core/base/result.h"

namespace flytri::report {

/// One page, HTML: the jaw colored by uncertainty, with distances and holes drawn in; what was
/// covered, how certain the distances are, the calibration, and what was edited. It prints on A4.
/// @errors  As io::encode_png.
[[nodiscard]] Result<std::string> report_page(const ScanFacts& facts);

}  // namespace flytri::report
