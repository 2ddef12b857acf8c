#include "core/io/cases/case_schema.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/io/cases/lost_start.h"
#include "core/io/files/file_bytes.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

/// "flyt": the mark of a case among SQLite databases.
constexpr std::int64_t kApplicationId = 0x666c7974;

// The defaults differ between releases of the library. Fixed numbers let a case open with all of
// them. Older releases ignore cipher_compatibility.
constexpr const char* kCipherSetup =
    "PRAGMA cipher_compatibility = 3; PRAGMA cipher_page_size = 8192; PRAGMA kdf_iter = 256000;";
constexpr const char* kPageSetup = "PRAGMA page_size = 8192;";
/// Protects against damaged and malicious files.
constexpr const char* kReadSetup =
    "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA trusted_schema = OFF;";
/// Keeps a second program out: two writers would mix up their scans.
constexpr const char* kLockSetup = "PRAGMA locking_mode = EXCLUSIVE;";
// In WAL mode the operating system has each commit when it returns, so a commit survives a killed
// process. With NORMAL the device must store it only at a checkpoint, every 1024 pages: a power
// failure costs what came after the checkpoint, but leaves no half transaction.
constexpr const char* kLogSetup =
    "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = 1024;";
/// For a file that gets its name when it is complete: its log is in memory.
constexpr const char* kNewSetup = "PRAGMA journal_mode = MEMORY;";
/// Lets the library open a file that is shorter than its header says.
constexpr const char* kSalvageSetup = "PRAGMA writable_schema = ON;";

std::string table_sql(CaseTable table) {
  return fmt::format(
      "CREATE TABLE {} (id INTEGER PRIMARY KEY, checksum INTEGER NOT NULL, data NOT NULL)",
      name_of(table));
}

/// The table of the journal, and triggers that refuse to change it.
std::vector<std::string> journal_sql() {
  const std::string table(name_of(CaseTable::kEvents));
  const std::string refuse = "BEGIN SELECT RAISE(ABORT, 'the journal only grows'); END";
  return {table_sql(CaseTable::kEvents),
          fmt::format("CREATE TRIGGER {0}_update BEFORE UPDATE ON {0} {1}", table, refuse),
          fmt::format("CREATE TRIGGER {0}_delete BEFORE DELETE ON {0} {1}", table, refuse),
          fmt::format("CREATE TRIGGER {0}_replace BEFORE INSERT ON {0} WHEN EXISTS (SELECT 1 FROM "
                      "{0} WHERE id = NEW.id) {1}",
                      table, refuse)};
}

/// Everything that a case of this version consists of.
std::vector<std::string> schema_sql(std::int64_t version) {
  std::vector<std::string> schema;
  for (const CaseTable table : kCaseTables) {
    if (table != CaseTable::kEvents) schema.push_back(table_sql(table));
  }
  if (version == kWithoutJournal) return schema;
  const std::vector<std::string> journal = journal_sql();
  schema.insert(schema.end(), journal.begin(), journal.end());
  return schema;
}

std::string joined(const std::vector<std::string>& statements) {
  std::string sql;
  for (const std::string& statement : statements) sql += statement + ";";
  return sql;
}

/// Accepts only what this version has: no other table, view or trigger.
Result<void> check_tables(SqliteDatabase& database, std::int64_t version) {
  auto statement = database.prepare("SELECT sql FROM sqlite_master");
  if (!statement) return tl::unexpected(statement.error());
  std::vector<std::string> found, wanted = schema_sql(version);
  for (;;) {
    const Result<bool> row = statement->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
    found.emplace_back(statement->bytes(0));
  }
  std::sort(found.begin(), found.end());
  std::sort(wanted.begin(), wanted.end());
  if (found == wanted) return {};
  return fail(ErrorCode::kBadFormat,
              "{}: damaged: its tables are not those of a case; restore the file from a backup",
              database.name());
}

/// The version, if this program reads it.
Result<std::int64_t> check_version(SqliteDatabase& database) {
  const auto application = database.integer("PRAGMA application_id");
  if (!application) return tl::unexpected(application.error());
  const auto version = database.integer("PRAGMA user_version");
  if (!version) return tl::unexpected(version.error());
  if (*application != kApplicationId) {
    return fail(ErrorCode::kBadFormat, "{}: is a database, but not a flytri case", database.name());
  }
  if (*version > kCaseVersion) {
    return fail(
        ErrorCode::kBadFormat,
        "{}: is a case of version {}, but this program reads versions up to {}; use a newer "
        "flytri",
        database.name(), *version, kCaseVersion);
  }
  if (*version >= kWithoutJournal) return *version;
  return fail(ErrorCode::kBadFormat, "{}: damaged: its version is {}, which does not exist",
              database.name(), *version);
}

Result<void> set_up(SqliteDatabase& database, const Secret& passphrase) {
  if (passphrase.empty()) return database.run(kReadSetup);
  return database.set_key(passphrase.view())
      .and_then([&] { return database.run(kCipherSetup); })
      .and_then([&] { return database.run(kReadSetup); });
}

/// Gives a case without a journal one: in the file, or for one that is only read, an empty one in
/// memory.
Result<void> add_journal(SqliteDatabase& database, SqliteAccess access) {
  if (access != SqliteAccess::kReadWrite) {
    return database.run("PRAGMA temp_store = MEMORY; CREATE TEMP" +
                        table_sql(CaseTable::kEvents).substr(std::string_view("CREATE").size()));
  }
  return database.run(fmt::format("BEGIN IMMEDIATE; {} PRAGMA user_version = {}; COMMIT;",
                                  joined(journal_sql()), kThreeStages));
}

/// Opens an existing file and checks its version and tables.
Result<SqliteDatabase> try_open(const fs::path& path, const Secret& passphrase, SqliteAccess access,
                                const char* more_setup, const char* file_system = nullptr) {
  Result<SqliteDatabase> database = SqliteDatabase::open(path, access, file_system);
  if (!database) return database;
  const auto version = set_up(*database, passphrase)
                           .and_then([&] { return database->run(more_setup); })
                           .and_then([&] { return check_version(*database); });
  if (!version) return tl::unexpected(version.error());
  Result<void> usable = check_tables(*database, *version);
  if (usable && *version == kWithoutJournal) usable = add_journal(*database, access);
  if (!usable) return tl::unexpected(usable.error());
  database->set_is_database();
  return database;
}

Result<CaseDatabase> open_to_write(const fs::path& path, const Secret& passphrase) {
  Result<SqliteDatabase> database =
      try_open(path, passphrase, SqliteAccess::kReadWrite, kLockSetup);
  if (!database) return tl::unexpected(database.error());
  // This changes the file, so it comes after the checks.
  if (Result<void> logging = database->run(kLogSetup); !logging) {
    return tl::unexpected(logging.error());
  }
  return CaseDatabase{std::move(*database), passphrase, false, {}};
}

/// Without a log next to it, the file is complete: no lock and no other file are needed.
SqliteAccess reading_access(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path.string() + "-wal", ignored) ? SqliteAccess::kReadOnly
                                                     : SqliteAccess::kImmutable;
}

/// Opens the file as requested. If it is damaged, opens it read-only with what can be read.
Result<CaseDatabase> open_with(const fs::path& path, const Secret& passphrase, bool read_only) {
  const auto open_to_read = [&](const char* more_setup) {
    return try_open(path, passphrase, reading_access(path), more_setup)
        .map([&passphrase](SqliteDatabase&& database) {
          return CaseDatabase{std::move(database), passphrase, true, {}};
        });
  };
  Result<CaseDatabase> opened = read_only ? open_to_read("") : open_to_write(path, passphrase);
  if (opened || opened.error().code != ErrorCode::kBadFormat) return opened;
  Result<CaseDatabase> salvaged = open_to_read(kSalvageSetup);
  if (salvaged) salvaged->damage.push_back(opened.error().message);
  return salvaged;
}

/// The first page of a new case.
Result<std::string> fresh_start() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  Result<AtomicFile> file = AtomicFile::create(folder / "case.flytri", Access::kOwnerOnly);
  if (!file) return tl::unexpected(file.error());
  return fill_case_database(file->temporary(), Secret()).and_then([&] {
    return read_file(file->temporary());
  });
}

/// Reads a case whose first page was overwritten.
Result<CaseDatabase> open_without_start(const fs::path& path) {
  const Result<std::string> start = fresh_start();
  if (!start) return tl::unexpected(start.error());
  return try_open(path, Secret(), reading_access(path), kSalvageSetup,
                  file_system_with_start(*start))
      .map([&](SqliteDatabase&& database) {
        std::string damage =
            fmt::format("{}: damaged: the start of the file was overwritten", path.string());
        return CaseDatabase{std::move(database), Secret(), true, {std::move(damage)}};
      });
}

Result<void> check_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    return fail(ErrorCode::kNotFound, "{}: there is no such case; check the path", path.string());
  }
  if (error) {
    return fail(ErrorCode::kNotPermitted, "{}: cannot be read: {}", path.string(), error.message());
  }
  if (!fs::is_regular_file(status)) {
    return fail(ErrorCode::kBadFormat, "{}: is not a file, so not a case", path.string());
  }
  if (fs::file_size(path, error) == 0) {
    return fail(ErrorCode::kBadFormat, "{}: the file is empty, so not a case", path.string());
  }
  return {};
}

}  // namespace

tl::unexpected<Error> under_final_name(Error error, const AtomicFile& file) {
  const std::size_t at = error.message.find(file.temporary());
  if (at != std::string::npos) {
    error.message.replace(at, file.temporary().size(), file.path().string());
  }
  return tl::unexpected(std::move(error));
}

Result<void> fill_case_database(const fs::path& path, const Secret& passphrase) {
  Result<SqliteDatabase> database = SqliteDatabase::open(path, SqliteAccess::kReadWrite);
  if (!database) return tl::unexpected(database.error());
  const std::string sql =
      fmt::format("BEGIN; {} PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT;",
                  joined(schema_sql(kThreeStages)), kApplicationId, kThreeStages);
  return set_up(*database, passphrase)
      .and_then([&] { return database->run(kPageSetup); })
      .and_then([&] { return database->run(kNewSetup); })
      .and_then([&] { return database->run(sql); });
}

std::string_view name_of(CaseTable table) {
  constexpr std::array<std::string_view, kCaseTables.size()> kNames = {
      "fields", "calibration",  "views",        "textures", "frames",    "poses",
      "edits",  "edit_cursors", "measurements", "models",   "summaries", "events"};
  return kNames[static_cast<std::size_t>(table)];
}

void remove_case(const fs::path& path) {
  std::error_code ignored;
  for (const char* ending : {"", "-wal", "-shm", "-journal"})
    fs::remove(path.string() + ending, ignored);
}

Result<CaseDatabase> create_case_database(const fs::path& path, const Secret& passphrase) {
  Result<AtomicFile> file = AtomicFile::create(path, Access::kOwnerOnly);
  if (!file) return tl::unexpected(file.error());
  Result<void> made = fill_case_database(file->temporary(), passphrase).and_then([&] {
    return file->commit_new();
  });
  if (!made) return under_final_name(made.error(), *file);
  Result<CaseDatabase> database = open_case_database(path, {passphrase, false});
  if (!database) remove_case(path);
  return database;
}

Result<CaseDatabase> open_case_database(const fs::path& path, const CaseOptions& options) {
  if (Result<void> there = check_file(path); !there) return tl::unexpected(there.error());
  Result<CaseDatabase> database = open_with(path, options.passphrase, options.read_only);
  if (!database && database.error().code == ErrorCode::kInconsistent &&
      !options.passphrase.empty()) {
    database = open_with(path, Secret(), options.read_only);
  }
  if (database || database.error().code != ErrorCode::kInconsistent) return database;
  if (has_lost_start(path)) return open_without_start(path);
  if (options.passphrase.empty()) {
    return fail(ErrorCode::kInconsistent,
                "{}: is encrypted, damaged at its start, or not a case; give its passphrase",
                path.string());
  }
  return fail(ErrorCode::kInconsistent,
              "{}: the passphrase is wrong, or the start of the file is damaged", path.string());
}

}  // namespace flytri::io
