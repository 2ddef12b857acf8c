/// @file  Exports all finished stages of a case in one frame.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "app/session/case_store.h"
#include "app/session/export_files.h"
#include "app/session/lighter_models.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "ui/state/command.h"

namespace flytri::session {

/// A finished stage.
struct JawToExport {
  io::ScanStage stage = io::ScanStage::kUpper;
  std::shared_ptr<const reconstruct::FinishedScan> scan;  ///< null: to be read from the case
  std::shared_ptr<LighterModels> lighter;                 ///< of the scan; null: none were made
};

/// Writes the files of reconstruct::write_jaws(). Only their owner may read them.
/// Scans that are read from the case are kept in `jaws`.
/// @param written  gets the models and reports that were written, also before a failure
/// @errors  As export_stem, CaseStore::load_model, reconstruct::place_jaws, report_file,
///          write_asked.
[[nodiscard]] Result<ExportOutcome> export_jaws(std::vector<JawToExport>& jaws, CaseStore& store,
                                                const ui::Export& command,
                                                std::vector<std::filesystem::path>& written,
                                                const ui::Texts& texts, const Progress& progress);

}  // namespace flytri::session
