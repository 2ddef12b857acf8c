/// @file  Writes what the window shows to files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/scan/scan_snapshot.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// About the size of each format's files, by extension. A finished scan is written as a mesh, an
/// unfinished one as points: formats that cannot hold it are missing.
[[nodiscard]] std::map<std::string_view, std::uint64_t> estimated_bytes(
    const scan::ScanSnapshot& shown);

/// @param stem  path of the files without their extension
/// @param formats  extensions, as in io::model_formats()
/// @errors  As write_model; kInsufficient: there is nothing to write, or the format cannot hold it.
[[nodiscard]] Result<std::vector<ui::ExportedFile>> export_files(
    const scan::ScanSnapshot& shown, const std::filesystem::path& stem,
    const std::vector<std::string_view>& formats);

}  // namespace flytri::session
