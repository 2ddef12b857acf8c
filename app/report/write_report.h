/// @file  Writes the report of a scan to a file.
#pragma once

#include <filesystem>
#include <string>

#include "app/report/scan_facts.h"
#include "core/base/result.h"

namespace flytri::report {

/// The kind of a report, for io::former_at: by its name, a page (".html") or JSON.
/// @errors  kBadOption: another extension.
[[nodiscard]] Result<std::string> report_kind(const std::filesystem::path& path);

/// Writes a page or JSON, by the name of the file, for its owner only.
/// @errors  As report_kind, report_page and write_file.
[[nodiscard]] Result<void> write_report(const std::filesystem::path& path, const ScanFacts& facts);

}  // namespace flytri::report
