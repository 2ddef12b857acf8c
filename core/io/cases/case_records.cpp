#include "core/io/cases/case_records.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

namespace flytri::io {
namespace {

constexpr int kNumberBits = 32;
/// The first one that programs of kThreeStages do not know.
constexpr ScanStage kFirstLaterStage = ScanStage::kBite2;

/// Includes the id, so that a record in the wrong place is noticed.
std::int64_t record_checksum(std::int64_t id, std::string_view data) {
  const uLong head = crc32_z(0, reinterpret_cast<const Bytef*>(&id), sizeof(id));
  // SQLite reads an empty record as null, of which zlib returns 0.
  if (data.empty()) return static_cast<std::int64_t>(head);
  return static_cast<std::int64_t>(
      crc32_z(head, reinterpret_cast<const Bytef*>(data.data()), data.size()));
}

/// Names a record for the user: "views: upper 17".
std::string name_of_record(CaseTable table, std::int64_t id) {
  if (id <= kOnlyRecord) return std::string(name_of(table));
  const std::optional<ScanStage> stage = stage_of(id);
  if (!stage) return fmt::format("{}: record {}", name_of(table), id);
  return fmt::format("{}: {} {}", name_of(table), to_string(*stage), number_of(id));
}

/// A database is whole in its one file only if no log of it is left. SQLite keeps an empty one
/// until it closes the file.
Result<void> no_log_left(const std::filesystem::path& closed) {
  for (const char* const suffix : {"-wal", "-journal"}) {
    std::error_code ignored;
    if (!std::filesystem::exists(closed.string() + suffix, ignored)) continue;
    return fail(ErrorCode::kWriteFailed, "{}: cannot be written; choose another folder",
                closed.string());
  }
  return {};
}

bool is_damage(const Error& error) { return error.code == ErrorCode::kBadFormat; }

/// The number in the first row. None: there is no row.
Result<std::optional<std::int64_t>> first_integer(SqliteDatabase& database, CaseTable table,
                                                  const RecordRange& range, std::string_view what) {
  auto statement = database.prepare(
      fmt::format("SELECT {} FROM {} WHERE id BETWEEN ? AND ? LIMIT 1", what, name_of(table)));
  if (!statement) return tl::unexpected(statement.error());
  const Result<bool> row = statement->bind(1, range.first).bind(2, range.last).step();
  if (!row) return tl::unexpected(row.error());
  return *row ? std::optional(statement->integer(0)) : std::nullopt;
}

/// Reads a range of records, and continues after damaged places.
class RecordWalk {
 public:
  RecordWalk(SqliteDatabase& database, CaseTable table, const RecordRange& range,
             const CaseRecords::Visit& visit)
      : database_(database), table_(table), next_(range.first), last_(range.last), visit_(visit) {}

  Result<std::vector<std::string>> run() {
    while (next_ <= last_) {
      const Result<void> walked = read_on();
      if (walked) break;
      if (!is_damage(walked.error())) return tl::unexpected(walked.error());
      if (Result<void> skipped = skip(); !skipped) return tl::unexpected(skipped.error());
    }
    return std::move(damage_);
  }

 private:
  /// Visits the records from next_ to the end, or up to the first that cannot be read.
  Result<void> read_on() {
    auto statement = database_.prepare(fmt::format(
        "SELECT id, checksum, data FROM {} WHERE id BETWEEN ? AND ? ORDER BY id", name_of(table_)));
    if (!statement) return tl::unexpected(statement.error());
    statement->bind(1, next_).bind(2, last_);
    // The step after the last record would read the next page, which may be damaged.
    while (next_ <= last_) {
      const Result<bool> row = statement->step();
      if (!row) return tl::unexpected(row.error());
      const std::int64_t id = *row ? statement->integer(0) : last_;
      // Only a damaged tree returns ids out of order.
      if (!*row || id < next_ || id > last_) return {};
      take(id, statement->integer(1), statement->bytes(2));
      next_ = id + 1;
    }
    return {};
  }

  void take(std::int64_t id, std::int64_t checksum, std::string_view data) {
    if (checksum != record_checksum(id, data)) {
      damage_.push_back(name_of_record(table_, id) + ": wrong checksum");
    } else if (const Result<void> taken = visit_(id, data); !taken) {
      damage_.push_back(name_of_record(table_, id) + ": " + taken.error().message);
    }
  }

  /// Notes the damage at next_, and moves past it.
  Result<void> skip() {
    const Result<std::optional<std::int64_t>> broken = next_id(next_);
    if (!broken && !is_damage(broken.error())) return tl::unexpected(broken.error());
    if (broken) {
      const std::int64_t id = broken->value_or(last_);
      damage_.push_back(name_of_record(table_, id) + ": cannot be read");
      next_ = id + 1;
      return {};
    }
    return skip_gap();
  }

  /// Not even the id can be read: a page is damaged, and with it a run of ids. Searches for its end
  /// with growing steps.
  Result<void> skip_gap() {
    const std::int64_t first = next_;
    std::int64_t failing = next_, stride = 1, good = last_ + 1;
    while (failing + stride < good) {
      const auto found = next_id(failing + stride);
      if (!found && !is_damage(found.error())) return tl::unexpected(found.error());
      if (found) {
        good = failing + stride;
        stride = 1;
      } else {
        failing += stride;
        stride *= 2;
      }
    }
    damage_.push_back(
        fmt::format("{} and the following records: cannot be read", name_of_record(table_, first)));
    next_ = good;
    return {};
  }

  /// The smallest id >= `from`.
  Result<std::optional<std::int64_t>> next_id(std::int64_t from) {
    return first_integer(database_, table_, {from, last_}, "id");
  }

  SqliteDatabase& database_;
  CaseTable table_;
  std::int64_t next_, last_;
  const CaseRecords::Visit& visit_;
  std::vector<std::string> damage_;
};

}  // namespace

std::int64_t record_id(ScanStage stage, int number) {
  return ((static_cast<std::int64_t>(stage) + 1) << kNumberBits) + number;
}

std::optional<ScanStage> stage_of(std::int64_t id) {
  const auto index = static_cast<std::size_t>(id >> kNumberBits) - 1;
  return index < kScanStages.size() ? std::optional(kScanStages[index]) : std::nullopt;
}

RecordRange records_of(ScanStage stage) {
  return {record_id(stage), record_id(stage, std::numeric_limits<int>::max())};
}

int number_of(std::int64_t id) {
  return static_cast<int>(id & ((std::int64_t{1} << kNumberBits) - 1));
}

CaseRecords::CaseRecords(CaseDatabase opened, const CaseOptions& options)
    : database_(std::move(opened.sqlite)),
      passphrase_(std::move(opened.passphrase)),
      is_read_only_(opened.is_read_only),
      is_damaged_(!opened.damage.empty()),
      max_waiting_bytes_(options.max_waiting_bytes),
      damage_(std::move(opened.damage)) {}

Result<CaseRecords> CaseRecords::create(const std::filesystem::path& path,
                                        const CaseOptions& options) {
  return create_case_database(path, options.passphrase).map([&](CaseDatabase&& database) {
    return CaseRecords(std::move(database), options);
  });
}

Result<CaseRecords> CaseRecords::open(const std::filesystem::path& path,
                                      const CaseOptions& options) {
  return open_case_database(path, options).map([&](CaseDatabase&& database) {
    return CaseRecords(std::move(database), options);
  });
}

Result<void> CaseRecords::begin() {
  if (is_damaged_) {
    const auto refused =
        fail(ErrorCode::kNotPermitted,
             "{}: is damaged, so nothing is written to it; save a rescue copy", database_.name());
    failure_ = refused.value();
    return refused;
  }
  if (is_read_only_) {
    return fail(ErrorCode::kNotPermitted, "{}: is open read-only", database_.name());
  }
  if (is_writing_) return {};
  if (Result<void> begun = database_.run("BEGIN IMMEDIATE"); !begun) {
    failure_ = begun.error();
    return begun;
  }
  is_writing_ = true;
  for (const PendingWrite& pending : pending_) {
    if (Result<void> done = carry_out(pending); !done) return postponed(done.error());
  }
  return {};
}

void CaseRecords::roll_back() {
  // After some failures the transaction has ended already; then this fails, too.
  (void)database_.run("ROLLBACK");
  is_writing_ = false;
  has_latest_version_ = false;
}

tl::unexpected<Error> CaseRecords::postponed(const Error& error) {
  roll_back();
  failure_ = error;
  if (!is_damage(error)) return tl::unexpected(error);
  is_damaged_ = true;
  failure_->message += "; nothing more is written to it: save a rescue copy";
  return tl::unexpected(*failure_);
}

Result<void> CaseRecords::insert(CaseTable table, std::int64_t id, std::string_view data) {
  std::optional<SqliteStatement>& insertion = insertions_[static_cast<std::size_t>(table)];
  if (!insertion) {
    auto prepared = database_.prepare(
        fmt::format("INSERT OR REPLACE INTO {} VALUES (?, ?, ?)", name_of(table)));
    if (!prepared) return tl::unexpected(prepared.error());
    insertion = *std::move(prepared);
  }
  insertion->bind(1, id).bind(2, record_checksum(id, data)).bind_blob(3, data);
  return insertion->step().map([](bool) {});
}

Result<void> CaseRecords::raise_version(std::int64_t id) {
  if (has_latest_version_ || id < record_id(kFirstLaterStage)) return {};
  Result<void> raised = database_.run(fmt::format("PRAGMA user_version = {}", kCaseVersion));
  has_latest_version_ = raised.has_value();
  return raised;
}

Result<void> CaseRecords::carry_out(const PendingWrite& pending) {
  if (pending.data) {
    return raise_version(pending.range.first).and_then([&] {
      return insert(pending.table, pending.range.first, *pending.data);
    });
  }
  auto statement = database_.prepare(
      fmt::format("DELETE FROM {} WHERE id BETWEEN ? AND ?", name_of(pending.table)));
  if (!statement) return tl::unexpected(statement.error());
  return statement->bind(1, pending.range.first).bind(2, pending.range.last).step().map([](bool) {
  });
}

Result<void> CaseRecords::write(PendingWrite pending) {
  const std::size_t bytes = pending.data ? pending.data->size() : 0;
  if (failure_ && pending_bytes_ + bytes > max_waiting_bytes_) {
    return fail(ErrorCode::kInsufficient,
                "{}: too much is waiting to be written, and new data are lost; free some space, or "
                "save in a new case in another folder",
                database_.name());
  }
  // Only commit() tries again: what waits may be much.
  Result<void> begun =
      failure_ && !is_read_only() ? Result<void>(tl::unexpected(*failure_)) : begin();
  // What was not opened to be written takes nothing; what was found damaged since, waits for a
  // rescue copy.
  if (!begun && is_read_only_) return begun;
  pending_.push_back(std::move(pending));
  pending_bytes_ += bytes;
  if (!begun) return begun;
  if (Result<void> done = carry_out(pending_.back()); !done) return postponed(done.error());
  return {};
}

Result<void> CaseRecords::add(CaseTable table, std::int64_t id, std::string_view data) {
  const auto there = first_integer(database_, table, {id, id}, "id");
  const bool is_pending =
      !is_writing_ && std::any_of(pending_.begin(), pending_.end(), [&](const PendingWrite& write) {
        return write.data && write.table == table && write.range.first == id;
      });
  if ((there && *there) || is_pending) {
    return fail(ErrorCode::kInconsistent, "{}: {} exists already", database_.name(),
                name_of_record(table, id));
  }
  return replace(table, id, data);
}

Result<void> CaseRecords::replace(CaseTable table, std::int64_t id, std::string_view data) {
  return write({table, {id, id}, std::string(data)});
}

Result<std::int64_t> CaseRecords::append(CaseTable table, const RecordRange& range,
                                         std::string_view data) {
  const auto stored = last(table, range);
  if (!stored) return tl::unexpected(stored.error());
  std::int64_t id = stored->value_or(range.first - 1);
  for (const PendingWrite& waiting : pending_) {
    const std::int64_t first = waiting.range.first;
    const bool is_one = waiting.data && waiting.table == table && first <= range.last;
    if (is_one) id = std::max(id, first);
  }
  return replace(table, id + 1, data).map([&] { return id + 1; });
}

Result<void> CaseRecords::erase(CaseTable table, const RecordRange& range) {
  return write({table, range, std::nullopt});
}

Result<void> CaseRecords::commit() {
  if (!is_writing_ && pending_.empty()) return {};
  if (Result<void> begun = begin(); !begun) return begun;
  if (Result<void> committed = database_.run("COMMIT"); !committed) {
    return postponed(committed.error());
  }
  is_writing_ = false;
  failure_.reset();
  pending_.clear();
  pending_bytes_ = 0;
  return {};
}

Result<void> CaseRecords::try_to_copy(const RecordCopy& copy) {
  // First whether all can be read. Not in one go: a write that fails ends statements that read.
  std::vector<std::int64_t> ids;
  const auto damage = walk(copy.table, copy.from, [&](std::int64_t id, std::string_view) {
    ids.push_back(id);
    return Result<void>();
  });
  if (!damage) return tl::unexpected(damage.error());
  if (!damage->empty()) {
    return fail(ErrorCode::kBadFormat, "{}: damaged: {}; save a rescue copy", database_.name(),
                damage->front());
  }
  for (const std::int64_t id : ids) {
    const auto data = find(copy.table, id);
    if (!data) return tl::unexpected(data.error());
    if (!*data) continue;
    const std::int64_t new_id = id + copy.shift;
    const auto renumbered = copy.renumber ? copy.renumber(**data, id, new_id)
                                          : Result<std::string>(std::string(**data));
    if (!renumbered) return tl::unexpected(renumbered.error());
    Result<void> inserted =
        raise_version(new_id).and_then([&] { return insert(copy.table, new_id, *renumbered); });
    if (!inserted) return inserted;
  }
  return {};
}

Result<void> CaseRecords::copy_records(const std::vector<RecordCopy>& copies) {
  if (Result<void> committed = commit(); !committed) return committed;
  Result<void> done = begin();
  for (const RecordCopy& copy : copies) {
    if (done) done = try_to_copy(copy);
  }
  if (done) done = database_.run("COMMIT");
  if (done) {
    is_writing_ = false;
    return done;
  }
  roll_back();
  // Nothing waits: all that was written before is committed.
  failure_.reset();
  return done;
}

Result<void> CaseRecords::copy_to_file(const std::filesystem::path& path,
                                       const CaseOptions& options) {
  Result<AtomicFile> file = AtomicFile::create(path, Access::kOwnerOnly);
  if (!file) return tl::unexpected(file.error());
  const std::filesystem::path temporary = file->temporary();
  // Takes the copy over, so that it is closed before it gets its name. Its log goes into the file.
  const auto copy = [&](CaseRecords target) {
    return copy_to(target).and_then(
        [&] { return target.database_.run("PRAGMA journal_mode = DELETE"); });
  };
  Result<void> copied = fill_case_database(temporary, options.passphrase)
                            .and_then([&] { return open(temporary, options); })
                            .and_then(copy)
                            .and_then([&] { return no_log_left(temporary); })
                            .and_then([&] { return file->commit_new(); });
  if (copied) return {};
  remove_case(temporary);
  return under_final_name(copied.error(), *file);
}

Result<void> CaseRecords::copy(CaseTable table, std::int64_t id, std::string_view data) {
  constexpr std::size_t kCommittedBytes = std::size_t{16} << 20U;
  return replace(table, id, data).and_then([&] {
    return pending_bytes_ > kCommittedBytes ? commit() : Result<void>();
  });
}

Result<void> CaseRecords::copy_to(CaseRecords& target) {
  const auto lost =
      rescue(&target, [](CaseTable, std::int64_t, std::string_view) { return Result<void>(); });
  if (!lost) return tl::unexpected(lost.error());
  if (lost->empty()) return {};
  return fail(ErrorCode::kBadFormat, "{}: damaged: {}", database_.name(), lost->front());
}

Result<std::vector<std::string>> CaseRecords::rescue(CaseRecords* target, const Read& read) {
  // A range for the tables with one record, and one for each stage: damage is named by stage.
  std::vector<RecordRange> ranges = {{0, record_id(kScanStages.front()) - 1}};
  for (const ScanStage stage : kScanStages) ranges.push_back(records_of(stage));
  std::vector<std::string> lost;
  Result<void> copied;
  for (const CaseTable table : kCaseTables) {
    for (const RecordRange& range : ranges) {
      const auto damage = walk(table, range, [&](std::int64_t id, std::string_view data) {
        Result<void> is_good = read(table, id, data);
        if (is_good && copied && target != nullptr) copied = target->copy(table, id, data);
        return is_good;
      });
      if (!damage) return tl::unexpected(damage.error());
      if (!copied) return tl::unexpected(copied.error());
      lost.insert(lost.end(), damage->begin(), damage->end());
    }
  }
  if (target == nullptr) return lost;
  for (const PendingWrite& pending : pending_) {
    if (Result<void> done = target->write(pending); !done) return tl::unexpected(done.error());
  }
  if (Result<void> done = target->commit(); !done) return tl::unexpected(done.error());
  return lost;
}

Result<std::optional<std::string>> CaseRecords::find(CaseTable table, std::int64_t id) {
  std::optional<std::string> found;
  const auto damage = walk(table, {id, id}, [&](std::int64_t, std::string_view data) {
    found = std::string(data);
    return Result<void>();
  });
  if (!damage) return tl::unexpected(damage.error());
  if (damage->empty()) return found;
  return fail(ErrorCode::kBadFormat, "{}: damaged: {}", database_.name(), damage->front());
}

Result<std::vector<std::string>> CaseRecords::walk(CaseTable table, const RecordRange& range,
                                                   const Visit& visit) {
  auto damage = RecordWalk(database_, table, range, visit).run();
  if (damage && !damage->empty()) is_damaged_ = true;
  return damage;
}

Result<std::int64_t> CaseRecords::count(CaseTable table, const RecordRange& range) {
  const auto counted = first_integer(database_, table, range, "count(*)");
  if (counted) return counted->value_or(0);
  if (!is_damage(counted.error())) return tl::unexpected(counted.error());
  std::int64_t readable = 0;
  const auto damage = walk(table, range, [&](std::int64_t, std::string_view) {
    ++readable;
    return Result<void>();
  });
  if (!damage) return tl::unexpected(damage.error());
  return readable;
}

Result<std::optional<std::int64_t>> CaseRecords::last(CaseTable table, const RecordRange& range) {
  return first_integer(database_, table, range, "max(id)").map([](const auto& largest) {
    // The maximum of nothing is null, which reads as 0. No record has this id.
    return largest == 0 ? std::nullopt : largest;
  });
}

}  // namespace flytri::io
