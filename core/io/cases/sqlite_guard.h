/// @file  Hardens a connection against crafted files.
///
/// For the sources of core/io/cases only.
#pragma once

struct sqlite3;

namespace flytri::io {

/// Sets small limits, and refuses every statement that a case does not need, whoever asks for it:
/// a trigger in the file, or this program by mistake. Where the library can, the schema is not
/// trusted and cannot be written.
void harden(sqlite3* database, bool is_read_only);

}  // namespace flytri::io
