/// @file  The database of a case: how its file is made, opened and told from others.
///
/// For the sources of core/interchange only.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/cases/case_file.h"
#include "core/io/cases/sqlite.h"

namespace flytri::io {

/// A table has records of one kind: id, checksum of id and data, data.
enum class CaseTable {
  kFields,        ///< one record: JSON
  kCalibration,   ///< one record: JSON
  kViews,         ///< by stage and frame: encode_view
  kTextures,      ///< by stage and frame: time, PNG
  kFrames,        ///< by stage and frame: JSON
  kPoses,         ///< by stage and frame
  kEdits,         ///< by stage and position in the sequence
  kEditCursors,   ///< by stage: how many of the edits hold
  kMeasurements,  ///< by stage and number: JSON
  kModels,        ///< by stage: .glb
  kSummaries      ///< by stage: JSON
};
inline constexpr std::array kCaseTables = {
    CaseTable::kFields,   CaseTable::kCalibration, CaseTable::kViews,
    CaseTable::kTextures, CaseTable::kFrames,      CaseTable::kPoses,
    CaseTable::kEdits,    CaseTable::kEditCursors, CaseTable::kMeasurements,
    CaseTable::kModels,   CaseTable::kSummaries};
[[nodiscard]] std::string_view name_of(CaseTable table);

/// An open database whose tables are known to be ours.
struct CaseDatabase {
  SqliteDatabase sqlite;
  bool is_read_only = false;
  std::vector<std::string> damage;  ///< why it is read-only although that was not asked for
};

/// Makes an empty file with the tables, for its owner alone. On failure none is left behind.
/// @errors  As CaseFile::create.
[[nodiscard]] Result<CaseDatabase> create_case_database(const std::filesystem::path& path,
                                                        const std::string& passphrase);

/// The file and what lies beside it while it is open.
void remove_case_files(const std::filesystem::path& path);

/// @errors  As CaseFile::open.
[[nodiscard]] Result<CaseDatabase> open_case_database(const std::filesystem::path& path,
                                                      const CaseOptions& options);

}  // namespace flytri::io
