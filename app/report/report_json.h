/// @file  The report of a scan for other programs.
#pragma once

#include <string>
#include <string_view>

#include "app/report/scan_facts.h"

namespace flytri::report {

/// The "format" of the file.
inline constexpr std::string_view kScanReportFormat = "flytri.scan-report";

/// What report_page() shows; the keys are documented in docs/formats.md.
[[nodiscard]] std::string report_json(const ScanFacts& facts);

}  // namespace flytri::report
