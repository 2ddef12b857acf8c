/// @file  The records in the tables of a case: numbered, with checksums, and readable even if parts
/// of the file are damaged.
///
/// For the sources of core/io/cases only.
#pragma once

#include <array>
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

/// A range of record ids, including both ends.
struct RecordRange {
  std::int64_t first = 0, last = 0;
};
/// The id of the record with this number >= 0. Tables with one record for each stage use number 0.
[[nodiscard]] std::int64_t record_id(ScanStage stage, int number = 0);
/// All records of a stage.
[[nodiscard]] RecordRange records_of(ScanStage stage);
/// None: the record belongs to no stage that this program knows.
[[nodiscard]] std::optional<ScanStage> stage_of(std::int64_t id);
/// The number within the stage.
[[nodiscard]] int number_of(std::int64_t id);

/// The id of the record in tables with only one.
inline constexpr std::int64_t kOnlyRecord = 1;

/// An open database of these tables. Writing opens a transaction if there is none. A write that
/// fails waits in memory, and so do all later ones, until a commit succeeds; see CaseFile.
class CaseRecords {
 public:
  /// Makes the tables in an empty file.
  [[nodiscard]] static Result<CaseRecords> create(const std::filesystem::path& path,
                                                  const CaseOptions& options);
  /// @errors  As CaseFile::open.
  [[nodiscard]] static Result<CaseRecords> open(const std::filesystem::path& path,
                                                const CaseOptions& options);

  [[nodiscard]] bool is_read_only() const { return is_read_only_ || is_damaged_; }
  /// True if damage was found, when the case was opened or since.
  [[nodiscard]] bool is_damaged() const { return is_damaged_; }
  /// True if writes wait because they failed.
  [[nodiscard]] bool has_waiting() const { return failure_ && !pending_.empty(); }
  [[nodiscard]] const std::vector<std::string>& damage() const { return damage_; }
  [[nodiscard]] const Secret& passphrase() const { return passphrase_; }

  /// @errors  Also kInconsistent: there is a record with this id.
  [[nodiscard]] Result<void> add(CaseTable table, std::int64_t id, std::string_view data);
  [[nodiscard]] Result<void> replace(CaseTable table, std::int64_t id, std::string_view data);
  /// Adds a record after the last one of the range, or of those that wait, and returns its id.
  [[nodiscard]] Result<std::int64_t> append(CaseTable table, const RecordRange& range,
                                            std::string_view data);
  [[nodiscard]] Result<void> erase(CaseTable table, const RecordRange& range);
  [[nodiscard]] Result<void> commit();
  /// Records that get a copy whose id is larger by `shift`.
  struct RecordCopy {
    CaseTable table;
    RecordRange from;
    std::int64_t shift;
    /// Null, or makes the data of the copy where they hold the id: data, id, new id.
    Result<std::string> (*renumber)(std::string_view, std::int64_t, std::int64_t) = nullptr;
  };
  /// Commits what was written before, and then all copies together. After a failure there is none
  /// of them; it does not wait to be repeated.
  /// @errors  Also kBadFormat: a record to copy is damaged.
  [[nodiscard]] Result<void> copy_records(const std::vector<RecordCopy>& copies);

  /// Copies all records to a new case, which gets its name when it is complete.
  /// @errors  As create; kBadFormat: a record cannot be read.
  [[nodiscard]] Result<void> copy_to_file(const std::filesystem::path& path,
                                          const CaseOptions& options);
  /// Reads all records of a case.
  /// @param target  an empty case that gets the records, and what waits to be written; null: none
  /// @param read  a record that it finds damaged is left out
  /// @return  what cannot be read, as walk()
  using Read = std::function<Result<void>(CaseTable table, std::int64_t id, std::string_view data)>;
  [[nodiscard]] Result<std::vector<std::string>> rescue(CaseRecords* target, const Read& read);

  /// None: there is no such record.
  /// @errors  Also kBadFormat: the record is damaged.
  [[nodiscard]] Result<std::optional<std::string>> find(CaseTable table, std::int64_t id);
  /// Called with the data of a record. Returns an error if they are damaged.
  using Visit = std::function<Result<void>(std::int64_t id, std::string_view data)>;
  /// Visits all records that can be read, by rising id. Returns a list of those that cannot be read
  /// or that the visitor found damaged; if there are any, the case is read-only from then on.
  [[nodiscard]] Result<std::vector<std::string>> walk(CaseTable table, const RecordRange& range,
                                                      const Visit& visit);
  /// If the table is damaged, the number of records that can be read.
  [[nodiscard]] Result<std::int64_t> count(CaseTable table, const RecordRange& range);
  /// The largest id in the range. None: there are no records.
  [[nodiscard]] Result<std::optional<std::int64_t>> last(CaseTable table, const RecordRange& range);

 private:
  CaseRecords(CaseDatabase opened, const CaseOptions& options);
  /// A write that is not committed yet.
  struct PendingWrite {
    CaseTable table;
    RecordRange range;
    std::optional<std::string> data;  ///< of the one record of the range; none: erases the range
  };
  [[nodiscard]] Result<void> copy_to(CaseRecords& target);
  [[nodiscard]] Result<void> begin();
  [[nodiscard]] Result<void> write(PendingWrite pending);
  [[nodiscard]] Result<void> carry_out(const PendingWrite& pending);
  /// Makes the case one of a version in which a record with this id is known.
  [[nodiscard]] Result<void> raise_version(std::int64_t id);
  /// Also commits now and then: what is not committed is in memory.
  [[nodiscard]] Result<void> copy(CaseTable table, std::int64_t id, std::string_view data);
  [[nodiscard]] Result<void> insert(CaseTable table, std::int64_t id, std::string_view data);
  [[nodiscard]] Result<void> try_to_copy(const RecordCopy& copy);
  void roll_back();
  /// Rolls the transaction back, so that the next one repeats it, and returns the failure.
  [[nodiscard]] tl::unexpected<Error> postponed(const Error& error);

  SqliteDatabase database_;
  Secret passphrase_;
  /// For each table: prepared once, as poses are written by thousands.
  std::array<std::optional<SqliteStatement>, kCaseTables.size()> insertions_;
  bool is_read_only_ = false;
  bool is_damaged_ = false;  ///< damage was found: nothing is written any more, all writes wait
  std::size_t max_waiting_bytes_;
  bool is_writing_ = false;            ///< a transaction is open
  bool has_latest_version_ = false;    ///< certainly
  std::optional<Error> failure_;       ///< of the latest write or commit; none: it succeeded
  std::vector<PendingWrite> pending_;  ///< since the last commit
  std::size_t pending_bytes_ = 0;
  std::vector<std::string> damage_;
};

}  // namespace flytri::io
