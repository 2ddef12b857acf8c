/// @file  Creates and opens the database of a case, and tells it from other databases.
///
/// For the sources of core/io/cases only.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/cases/case_file.h"
#include "core/io/cases/sqlite.h"
#include "core/io/files/atomic_file.h"

namespace flytri::io {

/// Each table has the columns id, checksum of id and data, data.
enum class CaseTable {
  kFields,        ///< one record: JSON
  kCalibration,   ///< one record: JSON
  kViews,         ///< by stage and frame: encode_view
  kTextures,      ///< by stage and frame: time, PNG
  kFrames,        ///< by stage and frame: JSON
  kPoses,         ///< by stage and frame
  kEdits,         ///< by stage and position in the sequence
  kEditCursors,   ///< by stage: how many of the edits apply
  kMeasurements,  ///< by stage and number: JSON
  kModels,        ///< by stage: .glb
  kSummaries,     ///< by stage: JSON
  kEvents         ///< by number, from 1: JSON; never changed
};
inline constexpr std::array kCaseTables = {
    CaseTable::kFields,   CaseTable::kCalibration, CaseTable::kViews,
    CaseTable::kTextures, CaseTable::kFrames,      CaseTable::kPoses,
    CaseTable::kEdits,    CaseTable::kEditCursors, CaseTable::kMeasurements,
    CaseTable::kModels,   CaseTable::kSummaries,   CaseTable::kEvents};
[[nodiscard]] std::string_view name_of(CaseTable table);

inline constexpr int kCasePageBytes = 8192;

/// Version 1: no journal; it gets one when it is opened for writing. Version 2: three stages.
/// Version 3: more stages; a case becomes one with the first record of such a stage. Older programs
/// would lose it in a copy, so they refuse version 3.
inline constexpr std::int64_t kWithoutJournal = 1, kThreeStages = 2, kCaseVersion = 3;

/// An open database with the tables of a case.
struct CaseDatabase {
  SqliteDatabase sqlite;
  Secret passphrase;  ///< that it is encrypted with; empty: it is not
  bool is_read_only = false;
  std::vector<std::string> damage;  ///< why it is read-only although the caller wants to write
};

/// Makes the tables in an empty file, and closes it.
/// @errors  As SqliteDatabase.
[[nodiscard]] Result<void> fill_case_database(const std::filesystem::path& path,
                                              const Secret& passphrase);

/// An error about the temporary file as one about the file that it was to become.
[[nodiscard]] tl::unexpected<Error> under_final_name(Error error, const AtomicFile& file);

/// Creates a file with the tables; only its owner may read it. The file gets its name when it is
/// complete. On failure no file is left.
/// @errors  As CaseFile::create.
[[nodiscard]] Result<CaseDatabase> create_case_database(const std::filesystem::path& path,
                                                        const Secret& passphrase);

/// @errors  As CaseFile::open.
[[nodiscard]] Result<CaseDatabase> open_case_database(const std::filesystem::path& path,
                                                      const CaseOptions& options);

}  // namespace flytri::io
