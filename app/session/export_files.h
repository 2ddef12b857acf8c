/// @file  Exports what the window shows.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/scan/scan_snapshot.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// Approximate size of a file. None: what is shown cannot be written in this format. A finished scan
/// is written as a mesh. An unfinished scan is written as points, which only .ply can store.
[[nodiscard]] std::optional<std::uint64_t> estimated_bytes(const scan::ScanSnapshot& shown,
                                                           ui::ExportFormat format);

/// @param stem  path of the files without the ending
/// @errors  As write_model and write_point_cloud_ply; kInsufficient: there is nothing to write.
[[nodiscard]] Result<std::vector<ui::ExportedFile>> export_files(
    const scan::ScanSnapshot& shown, const std::filesystem::path& stem,
    const std::vector<ui::ExportFormat>& formats);

}  // namespace flytri::session
