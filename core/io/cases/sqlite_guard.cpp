#include "core/io/cases/sqlite_guard.h"

#define SQLITE_HAS_CODEC  // NOLINT(readability-identifier-naming): the header's switch for keys
#include <sqlcipher/sqlite3.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace flytri::io {
namespace {

/// Largest number that the library takes of each kind. The statements of a case are short and
/// simple, and no record comes near the length; what needs more comes from a crafted file.
constexpr std::array<std::pair<int, int>, 9> kLimits = {{{SQLITE_LIMIT_LENGTH, 1 << 29},
                                                         {SQLITE_LIMIT_SQL_LENGTH, 1 << 16},
                                                         {SQLITE_LIMIT_COLUMN, 16},
                                                         {SQLITE_LIMIT_EXPR_DEPTH, 16},
                                                         {SQLITE_LIMIT_COMPOUND_SELECT, 1},
                                                         {SQLITE_LIMIT_FUNCTION_ARG, 8},
                                                         {SQLITE_LIMIT_ATTACHED, 0},
                                                         {SQLITE_LIMIT_VARIABLE_NUMBER, 16},
                                                         {SQLITE_LIMIT_TRIGGER_DEPTH, 1}}};

/// The pragmas that a case needs.
constexpr std::array<std::string_view, 17> kPragmas = {"application_id",
                                                       "cell_size_check",
                                                       "cipher_compatibility",
                                                       "cipher_memory_security",
                                                       "cipher_page_size",
                                                       "cipher_version",
                                                       "journal_mode",
                                                       "kdf_iter",
                                                       "locking_mode",
                                                       "mmap_size",
                                                       "page_size",
                                                       "synchronous",
                                                       "temp_store",
                                                       "trusted_schema",
                                                       "user_version",
                                                       "wal_autocheckpoint",
                                                       "wal_checkpoint"};

constexpr std::array<std::string_view, 3> kFunctions = {"count", "max", "zeroblob"};

template <std::size_t count>
bool is_one_of(const std::array<std::string_view, count>& names, const char* name) {
  return name != nullptr && std::find(names.begin(), names.end(), name) != names.end();
}

/// The tables in which the library itself notes a new table.
bool is_schema(const char* table) {
  return is_one_of(std::array<std::string_view, 2>{"sqlite_master", "sqlite_temp_master"}, table);
}

/// @param name  of the table or pragma
bool may_run(int action, const char* name, bool is_in_trigger, bool is_read_only) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
      return true;
    case SQLITE_TRANSACTION:
    case SQLITE_INSERT:
    case SQLITE_DELETE:
    case SQLITE_CREATE_TABLE:
    case SQLITE_CREATE_TEMP_TABLE:
    case SQLITE_CREATE_TRIGGER:
      return !is_in_trigger;
    case SQLITE_UPDATE:
      return !is_in_trigger && is_schema(name);
    case SQLITE_PRAGMA:
      // A damaged file that is only read is read by a schema that the library takes for granted.
      return is_one_of(kPragmas, name) ||
             (is_read_only && name == std::string_view("writable_schema"));
    default:
      return false;
  }
}

/// As the library calls it. @param origin  the trigger or view that asks; null: the program
int authorize(void* is_read_only, int action, const char* first, const char* second,
              const char* /*database*/, const char* origin) {
  const bool is_allowed = action == SQLITE_FUNCTION
                              ? is_one_of(kFunctions, second)
                              : may_run(action, first, origin != nullptr, is_read_only != nullptr);
  return is_allowed ? SQLITE_OK : SQLITE_DENY;
}

}  // namespace

void harden(sqlite3* database, bool is_read_only) {
  for (const auto& [kind, limit] : kLimits) sqlite3_limit(database, kind, limit);
  // Of the last argument only matters whether it is null.
  sqlite3_set_authorizer(database, authorize, is_read_only ? database : nullptr);
  // Debian 12 has SQLCipher 3.4.1 (SQLite 3.15), which knows neither; Debian 13 has both.
#ifdef SQLITE_DBCONFIG_TRUSTED_SCHEMA
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
#endif
#ifdef SQLITE_DBCONFIG_DEFENSIVE
  // Not where a damaged file is read: that needs a writable schema.
  if (!is_read_only) sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
#endif
}

}  // namespace flytri::io
