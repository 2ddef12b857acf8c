/// @file  Runs SQL statements on a database in one file, with error messages for the user.
///
/// For the sources of core/io/cases only. The library is SQLCipher: SQLite with encryption.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace flytri::io {

/// How to open an existing database.
enum class SqliteAccess {
  kReadWrite,
  kReadOnly,
  kImmutable  ///< read-only, and nobody else writes: takes no lock, creates no other file
};

/// One statement. Bound texts and bytes must live until the statement has been stepped.
class SqliteStatement {
 public:
  SqliteStatement& bind(int parameter, std::int64_t value);
  SqliteStatement& bind_blob(int parameter, std::string_view bytes);
  SqliteStatement& bind_text(int parameter, std::string_view text);
  /// True: there is a row. False: done; the statement may be bound and stepped again.
  /// @errors  As SqliteDatabase.
  [[nodiscard]] Result<bool> step();
  /// Ends the statement before its last row.
  void reset();

  [[nodiscard]] std::int64_t integer(int column) const;
  /// Bytes or text. Valid until the next step.
  [[nodiscard]] std::string_view bytes(int column) const;

 private:
  friend class SqliteDatabase;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  SqliteStatement(sqlite3_stmt* statement, std::string name, bool is_database)
      : statement_(statement), name_(std::move(name)), is_database_(is_database) {}

  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string name_;  ///< of the file, for messages
  bool is_database_;  ///< see SqliteDatabase
};

/// A connection. Closing it drops a transaction without commit.
/// @errors  All functions: kWriteFailed (disk full, failing device), kNotPermitted (permissions, or
///          another program has it open), kBadFormat (damaged, or it cannot be read),
///          kInconsistent (not a database, or a wrong passphrase).
class SqliteDatabase {
 public:
  /// Opens an existing file, but reads nothing yet. The connection is hardened against crafted
  /// files: small limits, and where the library can, no trust in the schema.
  /// @param file_system  that SQLite has registered under this name; null: the system's
  [[nodiscard]] static Result<SqliteDatabase> open(const std::filesystem::path& path,
                                                   SqliteAccess access,
                                                   const char* file_system = nullptr);
  /// Sets the passphrase. Call it before anything else.
  /// @errors  Also kInconsistent: this library cannot encrypt.
  [[nodiscard]] Result<void> set_key(std::string_view passphrase);

  /// Runs statements and ignores their rows.
  [[nodiscard]] Result<void> run(const std::string& sql);
  [[nodiscard]] Result<SqliteStatement> prepare(const std::string& sql);
  /// First column of the first row.
  /// @errors  Also kBadFormat: there is no row.
  [[nodiscard]] Result<std::int64_t> integer(const std::string& sql);
  /// Call it once something was read with the passphrase: from now on a page that does not look
  /// like one of a database is damaged, and the passphrase is right.
  void set_is_database() { is_database_ = true; }

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  SqliteDatabase(sqlite3* database, std::string name)
      : database_(database), name_(std::move(name)) {}

  std::unique_ptr<sqlite3, Close> database_;
  std::string name_;
  bool is_database_ = false;
};

}  // namespace flytri::io
