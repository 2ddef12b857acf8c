#include "core/io/files/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/io/files/file_errors.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

Result<std::string> read_descriptor(int descriptor, const fs::path& path) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return read_failure(path, errno);
  if (S_ISDIR(status.st_mode)) return read_failure(path, EISDIR);
  if (!S_ISREG(status.st_mode)) {
    return fail(ErrorCode::kBadFormat, "{}: is a device or a pipe; give the path of a file",
                path.string());
  }
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return read_failure(path, errno);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace

Result<void> check_writable(const fs::path& path) {
  return AtomicFile::create(path).map([](const AtomicFile&) {});
}

Result<void> write_file(const fs::path& path, std::string_view bytes, Access access) {
  Result<AtomicFile> file = AtomicFile::create(path, access);
  if (!file) return tl::unexpected(file.error());
  if (Result<void> written = file->write(bytes); !written) return written;
  return file->commit();
}

Result<void> sync_file(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return write_failure(path, errno);
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0) return write_failure(path, error);
  return {};
}

Result<std::string> read_file(const fs::path& path) {
  // O_NONBLOCK: a pipe is refused at once instead of waited for.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return read_failure(path, errno);
  Result<std::string> bytes = read_descriptor(descriptor, path);
  ::close(descriptor);
  return bytes;
}

Result<void> create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return write_failure(folder, error.value());
  return {};
}

Result<void> create_private_folder(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return {};
  if (auto parent = create_private_folder(folder.parent_path()); !parent) return parent;
  // A path that ends in / names the folder that was just made.
  const int failure = ::mkdir(folder.c_str(), 0700) == 0 ? 0 : errno;
  if (failure == 0 || fs::is_directory(folder, error)) return {};
  return write_failure(folder, failure);
}

}  // namespace flytri::io
