/// @file  A database in one file: statements in, rows out, with errors in the user's words.
///
/// For the sources of core/interchange only. The library is SQLCipher, which is SQLite with a key.
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

/// How a database that exists already is opened.
enum class SqliteAccess {
  kReadWrite,
  kReadOnly,
  kImmutable  ///< read-only, and nobody else writes: no lock is taken, no file made beside it
};

/// One statement. What it binds by reference must live until it was stepped.
class SqliteStatement {
 public:
  SqliteStatement& bind(int parameter, std::int64_t value);
  SqliteStatement& bind_blob(int parameter, std::string_view bytes);
  SqliteStatement& bind_text(int parameter, std::string_view text);
  /// True: there is a row. False: done, and ready to be bound and stepped again.
  /// @errors  As SqliteDatabase.
  [[nodiscard]] Result<bool> step();
  /// Ends the walk before its last row.
  void reset();

  [[nodiscard]] std::int64_t integer(int column) const;
  /// Bytes or text, valid until the next step.
  [[nodiscard]] std::string_view bytes(int column) const;

 private:
  friend class SqliteDatabase;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  SqliteStatement(sqlite3_stmt* statement, std::string name)
      : statement_(statement), name_(std::move(name)) {}

  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string name_;  ///< of the file, for messages
};

/// A connection. Closing it drops a transaction that was not committed.
/// @errors  Of all functions: kWriteFailed (disk full, failing device), kNotPermitted (permissions,
/// or
///          another program has it open), kBadFormat (damaged), kInconsistent (no database, or a
///          wrong key).
class SqliteDatabase {
 public:
  /// Opens a file that exists; nothing is read from it yet.
  [[nodiscard]] static Result<SqliteDatabase> open(const std::filesystem::path& path,
                                                   SqliteAccess access);
  /// The passphrase of the file, before anything else is done.
  /// @errors  Also kInconsistent: the library at hand cannot encrypt.
  [[nodiscard]] Result<void> set_key(std::string_view passphrase);

  /// Runs statements that give no rows, or whose rows do not matter.
  [[nodiscard]] Result<void> run(const std::string& sql);
  [[nodiscard]] Result<SqliteStatement> prepare(const std::string& sql);
  /// First column of the first row.
  /// @errors  Also kBadFormat: there is no row.
  [[nodiscard]] Result<std::int64_t> integer(const std::string& sql);

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  SqliteDatabase(sqlite3* database, std::string name)
      : database_(database), name_(std::move(name)) {}

  std::unique_ptr<sqlite3, Close> database_;
  std::string name_;
};

}  // namespace flytri::io
