#include "core/io/cases/sqlite.h"

#define SQLITE_HAS_CODEC  // NOLINT(readability-identifier-naming): the header's switch for keys
#include <sqlcipher/sqlite3.h>

#include <system_error>
#include <utility>

#include "core/io/cases/sqlite_guard.h"

namespace flytri::io {
namespace {

/// What a call was for: the library has the same codes for different failures.
struct SqliteCall {
  bool only_reads = false;
  bool is_database = false;  ///< something was read before, so that the passphrase is right
};

/// A failure while reading. The library says "full" if a page names one far behind the end.
tl::unexpected<Error> read_failure(int code, const std::string& name) {
  if (code == SQLITE_FULL) {
    return fail(ErrorCode::kBadFormat, "{}: damaged: a page names another one that is not there",
                name);
  }
  if (code == SQLITE_IOERR_SHORT_READ) {
    return fail(ErrorCode::kBadFormat, "{}: damaged: the file is cut off", name);
  }
  return fail(ErrorCode::kBadFormat,
              "{}: damaged: the device cannot read a part of it; copy the file to another disk",
              name);
}

/// Says what a failed call means for the user, and what to do.
/// @errors  kWriteFailed (disk full, failing device), kNotPermitted (no permission, or another
///          program has it open), kBadFormat (damaged), kInconsistent (not a database, wrong
///          passphrase).
tl::unexpected<Error> sqlite_failure(int code, const std::string& name, const SqliteCall& call) {
  const int kind = code & 0xff;
  const bool has_read =
      call.only_reads || code == SQLITE_IOERR_READ || code == SQLITE_IOERR_SHORT_READ;
  if (has_read && (kind == SQLITE_FULL || kind == SQLITE_IOERR)) return read_failure(code, name);
  switch (kind) {
    case SQLITE_FULL:
      return fail(ErrorCode::kWriteFailed,
                  "{}: cannot be written: no space left; free some space or choose another folder",
                  name);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return fail(ErrorCode::kNotPermitted, "{}: is open in another program; close it there first",
                  name);
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
    case SQLITE_CANTOPEN:
      return fail(ErrorCode::kNotPermitted,
                  "{}: cannot be opened or written: change the permissions of the file and its "
                  "folder, or choose another folder",
                  name);
    case SQLITE_TOOBIG:
      return fail(ErrorCode::kBadFormat,
                  "{}: damaged: a record is larger than any of a case can be", name);
    case SQLITE_NOTADB:
      if (call.is_database) {
        return fail(ErrorCode::kBadFormat, "{}: damaged: the start of the file was overwritten",
                    name);
      }
      return fail(ErrorCode::kInconsistent,
                  "{}: is not a database, or encrypted with another passphrase", name);
    case SQLITE_IOERR:
      return fail(ErrorCode::kWriteFailed,
                  "{}: cannot be written: the device has failed; choose another folder", name);
    default:
      return fail(ErrorCode::kBadFormat, "{}: damaged: {}", name, sqlite3_errstr(code));
  }
}

/// The path as a URI. Characters with a meaning in URIs are escaped.
std::string sqlite_uri(const std::filesystem::path& path, SqliteAccess access) {
  std::string uri = "file:";
  std::error_code ignored;
  for (const char letter : std::filesystem::absolute(path, ignored).string()) {
    if (letter == '%' || letter == '?' || letter == '#') {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    } else {
      uri += letter;
    }
  }
  return access == SqliteAccess::kImmutable ? uri + "?immutable=1" : uri;
}

}  // namespace

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteStatement& SqliteStatement::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), parameter, value);
  return *this;
}

SqliteStatement& SqliteStatement::bind_blob(int parameter, std::string_view bytes) {
  // An empty blob is not the same as none, which a null pointer would be.
  sqlite3_bind_blob64(statement_.get(), parameter, bytes.empty() ? "" : bytes.data(), bytes.size(),
                      SQLITE_STATIC);
  return *this;
}

SqliteStatement& SqliteStatement::bind_text(int parameter, std::string_view text) {
  sqlite3_bind_text64(statement_.get(), parameter, text.empty() ? "" : text.data(), text.size(),
                      SQLITE_STATIC, SQLITE_UTF8);
  return *this;
}

Result<bool> SqliteStatement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  const int failure = sqlite3_extended_errcode(sqlite3_db_handle(statement_.get()));
  const bool only_reads = sqlite3_stmt_readonly(statement_.get()) != 0;
  reset();
  if (code == SQLITE_DONE) return false;
  return sqlite_failure(failure, name_, {only_reads, is_database_});
}

void SqliteStatement::reset() { sqlite3_reset(statement_.get()); }

std::int64_t SqliteStatement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string_view SqliteStatement::bytes(int column) const {
  const void* const data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return {static_cast<const char*>(data), static_cast<std::size_t>(data == nullptr ? 0 : size)};
}

void SqliteDatabase::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Result<SqliteDatabase> SqliteDatabase::open(const std::filesystem::path& path, SqliteAccess access,
                                            const char* file_system) {
  const int flags =
      access == SqliteAccess::kReadWrite ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY;
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(sqlite_uri(path, access).c_str(), &opened,
                                   flags | SQLITE_OPEN_URI, file_system);
  SqliteDatabase database(opened, path.string());
  if (code != SQLITE_OK) return sqlite_failure(code, path.string(), {});
  sqlite3_extended_result_codes(opened, 1);
  harden(opened, access != SqliteAccess::kReadWrite);
  // Where writing is not permitted, the library goes on reading without a word.
  if (access == SqliteAccess::kReadWrite && sqlite3_db_readonly(opened, "main") == 1) {
    return sqlite_failure(SQLITE_READONLY, path.string(), {});
  }
  return database;
}

Result<void> SqliteDatabase::set_key(std::string_view passphrase) {
  // Otherwise later releases do not lock the memory of the passphrase; older ones always do.
  if (Result<void> locked = run("PRAGMA cipher_memory_security = ON"); !locked) return locked;
  const int code = sqlite3_key_v2(database_.get(), "main", passphrase.data(),
                                  static_cast<int>(passphrase.size()));
  if (code != SQLITE_OK) return sqlite_failure(code, name_, {});
  // A plain SQLite in the place of SQLCipher would take the key and write everything in the open.
  if (!prepare("PRAGMA cipher_version")
           .and_then([](SqliteStatement statement) { return statement.step(); })
           .value_or(false)) {
    return fail(ErrorCode::kInconsistent,
                "{}: cannot be encrypted: the program runs with a library without encryption; "
                "install SQLCipher",
                name_);
  }
  return {};
}

Result<void> SqliteDatabase::run(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return {};
  return sqlite_failure(sqlite3_extended_errcode(database_.get()), name_, {false, is_database_});
}

Result<SqliteStatement> SqliteDatabase::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()),
                                      &statement, nullptr);
  if (code != SQLITE_OK) {
    // To understand a statement, the library reads the tables.
    return sqlite_failure(sqlite3_extended_errcode(database_.get()), name_, {true, is_database_});
  }
  return SqliteStatement(statement, name_, is_database_);
}

Result<std::int64_t> SqliteDatabase::integer(const std::string& sql) {
  Result<SqliteStatement> statement = prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  const Result<bool> row = statement->step();
  if (!row) return tl::unexpected(row.error());
  if (!*row) return fail(ErrorCode::kBadFormat, "{}: damaged: no answer to {}", name_, sql);
  return statement->integer(0);
}

}  // namespace flytri::io
