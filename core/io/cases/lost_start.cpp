#include "core/io/cases/lost_start.h"

#define SQLITE_HAS_CODEC  // NOLINT(readability-identifier-naming): the header's switch for keys
#include <sqlcipher/sqlite3.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>

#include "core/io/cases/case_schema.h"

namespace flytri::io {
namespace {

// Places in the header of a database: https://www.sqlite.org/fileformat.html, section 1.3.
constexpr std::string_view kMagic("SQLite format 3\0", 16);
constexpr std::size_t kPageCountAt = 28;
/// Kinds of pages in section 1.6, of which tables consist.
constexpr unsigned char kInnerPage = 0x05, kLeafPage = 0x0D;
constexpr std::size_t kContentAt = 5, kFragmentsAt = 7, kPageHeaderBytes = 8;
constexpr int kMostFragments = 60;

/// Fewer may be there by chance, or because the file is another database.
constexpr int kFewestTables = 4;

/// Reads fewer bytes at the end of the file, none where it cannot be read.
std::string read_at(std::ifstream& file, std::int64_t at, std::size_t count) {
  std::string bytes(count, '\0');
  file.clear();
  file.seekg(at);
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool is_of_table(std::string_view page) {
  if (page.size() < kPageHeaderBytes) return false;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(page[at]); };
  return (byte(0) == kInnerPage || byte(0) == kLeafPage) &&
         (byte(kContentAt) << 8 | byte(kContentAt + 1)) <= kCasePageBytes &&
         byte(kFragmentsAt) <= kMostFragments;
}

std::array<char, kCasePageBytes> start_page;
sqlite3_vfs files_with_start;
sqlite3_vfs* system_files = nullptr;

/// What is kept behind SQLite's own object of an open file.
struct FileWithStart {
  const sqlite3_io_methods* system;
  sqlite3_io_methods methods;
};

FileWithStart* behind(sqlite3_file* file) {
  return reinterpret_cast<FileWithStart*>(reinterpret_cast<char*>(file) + system_files->szOsFile);
}

int read_with_start(sqlite3_file* file, void* target, int count, sqlite3_int64 at) {
  const sqlite3_io_methods& system = *behind(file)->system;
  if (at + count > kCasePageBytes) return system.xRead(file, target, count, at);
  sqlite3_int64 size = 0;
  const int sized = system.xFileSize(file, &size);
  if (sized != SQLITE_OK) return sized;
  std::array<char, kCasePageBytes> page = start_page;
  auto pages = static_cast<std::uint32_t>(size / kCasePageBytes);
  for (std::size_t i = 4; i-- > 0; pages >>= 8U) {
    page[kPageCountAt + i] = static_cast<char>(pages & 0xffU);
  }
  std::memcpy(target, page.data() + at, static_cast<std::size_t>(count));
  return SQLITE_OK;
}

/// Opens as the system does. A database, but not its log, gets another function to read.
int open_with_start(sqlite3_vfs* /*self*/, const char* name, sqlite3_file* file, int flags,
                    int* flags_then) {
  const int opened = system_files->xOpen(system_files, name, file, flags, flags_then);
  if (opened != SQLITE_OK || (flags & SQLITE_OPEN_MAIN_DB) == 0) return opened;
  FileWithStart* const with_start =
      new (behind(file)) FileWithStart{file->pMethods, *file->pMethods};
  with_start->methods.xRead = read_with_start;
  file->pMethods = &with_start->methods;
  return opened;
}

}  // namespace

bool has_lost_start(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (read_at(file, 0, kMagic.size()) == kMagic) return false;
  int tables = 0;
  for (std::size_t page = 1; page <= kCaseTables.size(); ++page) {
    const std::string header =
        read_at(file, static_cast<std::int64_t>(page) * kCasePageBytes, kPageHeaderBytes);
    tables += is_of_table(header) ? 1 : 0;
  }
  return tables >= kFewestTables;
}

const char* file_system_with_start(const std::string& page) {
  static const bool is_registered = [&] {
    std::memcpy(start_page.data(), page.data(), std::min(page.size(), start_page.size()));
    system_files = sqlite3_vfs_find(nullptr);
    files_with_start = *system_files;
    files_with_start.pNext = nullptr;
    files_with_start.szOsFile += static_cast<int>(sizeof(FileWithStart));
    files_with_start.zName = "case-with-start";
    files_with_start.xOpen = open_with_start;
    return sqlite3_vfs_register(&files_with_start, 0) == SQLITE_OK;
  }();
  return is_registered ? files_with_start.zName : nullptr;
}

}  // namespace flytri::io
