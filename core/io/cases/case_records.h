/// @file  The records in a case's tables: numbered, with checksums, read even where the file is
/// damaged.
///
/// For the sources of core/interchange only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/cases/case_file.h"
#include "core/io/cases/case_schema.h"

namespace flytri::io {

/// The numbers of records, both ends included.
struct RecordRange {
  std::int64_t first = 0, last = 0;
};
/// The record of a stage and a number >= 0. Number 0 stands for tables with one record a stage.
[[nodiscard]] std::int64_t record_id(ScanStage stage, int number = 0);
/// All records of a stage.
[[nodiscard]] RecordRange records_of(ScanStage stage);
/// The number within the stage.
[[nodiscard]] int number_of(std::int64_t id);

/// The only record of the tables that have one.
inline constexpr std::int64_t kOnlyRecord = 1;

/// An open database of these tables. Writing opens a transaction if there is none. A write that
/// fails waits in memory and is tried again with the next write or commit; CaseFile says what
/// follows from that for its callers.
class CaseRecords {
 public:
  /// Makes the tables in an empty file.
  [[nodiscard]] static Result<CaseRecords> create(const std::filesystem::path& path,
                                                  const CaseOptions& options);
  /// @errors  As CaseFile::open.
  [[nodiscard]] static Result<CaseRecords> open(const std::filesystem::path& path,
                                                const CaseOptions& options);

  [[nodiscard]] bool is_read_only() const { return is_read_only_ || is_damaged_; }
  /// True if writes wait because they failed.
  [[nodiscard]] bool has_waiting() const { return is_failing_ && !pending_.empty(); }
  [[nodiscard]] const std::vector<std::string>& damage() const { return damage_; }

  /// @errors  Also kInconsistent: there is a record of that number.
  [[nodiscard]] Result<void> add(CaseTable table, std::int64_t id, std::string_view data);
  [[nodiscard]] Result<void> replace(CaseTable table, std::int64_t id, std::string_view data);
  [[nodiscard]] Result<void> erase(CaseTable table, const RecordRange& range);
  [[nodiscard]] Result<void> commit();

  /// None: there is no such record.
  /// @errors  Also kBadFormat: it is there, but damaged.
  [[nodiscard]] Result<std::optional<std::string>> find(CaseTable table, std::int64_t id);
  /// Takes a record's data; an error tells what is wrong with it.
  using Visit = std::function<Result<void>(std::int64_t id, std::string_view data)>;
  /// Visits all that can be read, by rising number. What cannot, or was refused by the visitor, is
  /// told by the list that is returned, and ends all writing.
  [[nodiscard]] Result<std::vector<std::string>> walk(CaseTable table, const RecordRange& range,
                                                      const Visit& visit);
  /// Where the table is damaged, of those that can be read.
  [[nodiscard]] Result<std::int64_t> count(CaseTable table, const RecordRange& range);
  /// Largest number in the range; none: it is empty.
  [[nodiscard]] Result<std::optional<std::int64_t>> last(CaseTable table, const RecordRange& range);

 private:
  CaseRecords(CaseDatabase opened, const CaseOptions& options);
  /// A write that is not committed yet.
  struct PendingWrite {
    CaseTable table;
    RecordRange range;
    std::optional<std::string> data;  ///< of the only record of the range; none: it is erased
  };
  [[nodiscard]] Result<void> begin();
  [[nodiscard]] Result<void> write(PendingWrite pending);
  [[nodiscard]] Result<void> carry_out(const PendingWrite& pending);
  /// Rolls the transaction back, so that the next one repeats it, and returns the failure.
  [[nodiscard]] tl::unexpected<Error> postponed(const Error& error);

  SqliteDatabase database_;
  bool is_read_only_ = false;
  bool is_damaged_ = false;            ///< found so: nothing is written any more
  std::size_t max_waiting_bytes_;
  bool is_writing_ = false;            ///< a transaction is open
  bool is_failing_ = false;            ///< a write has failed since the last successful commit
  std::vector<PendingWrite> pending_;  ///< since the last commit
  std::size_t pending_bytes_ = 0;
  std::vector<std::string> damage_;
};

}  // namespace flytri::io
