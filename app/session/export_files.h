/// @file  Exports what the window shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/scan_facts.h"
#include "app/session/lighter_models.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/scan/scan_snapshot.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

/// About the size of each format's files, by extension. A finished scan is written as a mesh, an
/// unfinished one as points: formats that cannot hold it are missing.
/// @param model  of a finished scan, as it would be written; null: not known yet, all sizes are 0
[[nodiscard]] std::map<std::string_view, std::uint64_t> estimated_bytes(
    const scan::ScanSnapshot& shown, const TexturedMesh* model);

/// What an export did.
struct ExportOutcome {
  std::vector<ui::ExportedFile> written;
  /// Paths of files that exist and may not be replaced: then nothing is written.
  std::vector<std::string> existing;
};

/// The path of the files without their extension: the folder, where ~ is the home folder, and the
/// name in it.
/// @param texts  for messages
/// @errors  kBadOption: the name is empty or would leave the folder, or there is no folder;
///          kNotFound: there is no home folder.
[[nodiscard]] Result<std::filesystem::path> export_stem(const ui::ExportTarget& target,
                                                        const ui::Texts& texts = {});

/// The files that are written for a model: without a texture only one.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const std::filesystem::path& model,
                                                          bool has_texture);

/// Writes files, unless some exist that may not be replaced.
/// @param files     all files that `write` writes; their folder is created if needed
/// @param replaced  paths of files that may be replaced
/// @errors  kBadOption: a folder, or a file of another kind, has the name; as `write`.
[[nodiscard]] Result<ExportOutcome> write_asked(const std::vector<std::filesystem::path>& files,
                                                const std::vector<std::string>& replaced,
                                                const std::function<Result<void>()>& write);

/// Finds what the report of a scan says. Empty: nothing is known of it.
using FindFacts = std::function<Result<report::ScanFacts>()>;

/// A report that is to be written.
struct ReportFile {
  std::filesystem::path path;
  report::ScanFacts facts;
};
/// @param texts  for messages
/// @errors  As `find`; kInsufficient: it is empty.
[[nodiscard]] Result<ReportFile> report_file(const std::filesystem::path& path,
                                             const FindFacts& find, const ui::Texts& texts);
/// @param written  gets those that are complete
/// @errors  As report::write_report.
[[nodiscard]] Result<void> write_reports(const std::vector<ReportFile>& reports,
                                         std::vector<std::filesystem::path>& written);

/// What the window shows, to be exported.
struct ShownScan {
  const scan::ScanSnapshot& scan;
  /// Of the finished scan: keeps the mesh that is made. Null: nothing is kept.
  LighterModels* lighter = nullptr;
  FindFacts facts = {};
  std::vector<io::StoredMargin> margins = {};  ///< of its finished model; written beside it
};

/// Files and new folders are for their owner only. If a report cannot be made, no file is written.
/// @param texts  for messages
/// @param written  gets the models and reports that were written, also before a failure
/// @errors  As export_stem, write_model and report_file; kInsufficient: nothing to write, or the
///          format cannot hold it; kBadOption: a folder, or a file of another kind, has the name.
[[nodiscard]] Result<ExportOutcome> export_files(const ShownScan& shown, const ui::Export& command,
                                                 std::vector<std::filesystem::path>& written,
                                                 const ui::Texts& texts = {},
                                                 const Progress& progress = {});
[[nodiscard]] inline Result<ExportOutcome> export_files(const scan::ScanSnapshot& shown,
                                                        const ui::Export& command) {
  std::vector<std::filesystem::path> written;
  return export_files(ShownScan{shown}, command, written);
}

}  // namespace flytri::session
