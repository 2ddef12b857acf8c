/// @file  Writes what the window shows to files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/scan/scan_snapshot.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// About what a file will weigh; none: what is shown cannot be written so. A finished scan is
/// written as its mesh, one that is under way as its points, which is .ply alone.
[[nodiscard]] std::optional<std::uint64_t> estimated_bytes(const scan::ScanSnapshot& shown,
                                                           ui::ExportFormat format);

/// @param stem  path of the files without their ending
/// @errors  As write_model and write_point_cloud_ply; kInsufficient: there is nothing to write.
[[nodiscard]] Result<std::vector<ui::ExportedFile>> export_files(
    const scan::ScanSnapshot& shown, const std::filesystem::path& stem,
    const std::vector<ui::ExportFormat>& formats);

}  // namespace flytri::session
