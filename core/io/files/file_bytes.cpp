#include "core/io/files/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <random>
#include <system_error>
#include <utility>

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

std::string_view remedy_of_writing(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "; free some space or choose another folder";
    case EFBIG:
      return "; the file system or a limit of this account allows no larger files";
    case EACCES:
    case EPERM:
      return "; change the permissions or choose another folder";
    case EROFS:
      return "; choose a folder that can be written to";
    case ENOENT:
    case ENOTDIR:
      return "; create the folder first or correct the path";
    default:
      return "";
  }
}

std::string_view remedy_of_reading(int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      return "; change the permissions";
    case ENOENT:
    case ENOTDIR:
      return "; correct the path";
    case EISDIR:
      return "; name a file";
    default:
      return "";
  }
}

ErrorCode code_of(int error, ErrorCode otherwise) {
  if (error == EACCES || error == EPERM || error == EROFS) return ErrorCode::kNotPermitted;
  if (error == ENOENT || error == ENOTDIR) return ErrorCode::kNotFound;
  return otherwise;
}

tl::unexpected<Error> write_failure(const fs::path& path, int error) {
  return fail(code_of(error, ErrorCode::kWriteFailed), "{}: cannot be written: {}{}", path.string(),
              std::generic_category().message(error), remedy_of_writing(error));
}

tl::unexpected<Error> read_failure(const fs::path& path, int error) {
  return fail(code_of(error, ErrorCode::kBadFormat), "{}: cannot be read: {}{}", path.string(),
              std::generic_category().message(error), remedy_of_reading(error));
}

/// Those of the file that is replaced, if there is one; else they stay those of a new file.
void take_over_permissions(int descriptor, const fs::path& path) {
  struct stat former {};
  // Without it the file is still whole and its owner's, so a failure here is no reason to stop.
  if (::stat(path.c_str(), &former) == 0) (void)::fchmod(descriptor, former.st_mode & 07777U);
}

/// A file's new name is its folder's, which is flushed on its own: where it may be opened, and the
/// file system knows of such a thing. Else the file is there all the same.
Result<void> sync_folder_of(const fs::path& path) {
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return {};
  const int error = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  ::close(descriptor);
  if (error != 0) return write_failure(path, error);
  return {};
}

}  // namespace

AtomicFile::AtomicFile(fs::path path, std::string temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  path_ = std::move(other.path_);
  temporary_ = std::move(other.temporary_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
  descriptor_ = -1;
}

Result<AtomicFile> AtomicFile::create(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    return fail(ErrorCode::kWriteFailed, "{}: is a folder; name a file", path.string());
  }
  std::random_device random;
  std::string temporary;
  int descriptor = -1;
  do {
    // Hidden and short, so that a long name of the file itself does not overflow the limit.
    temporary = (path.parent_path() / fmt::format(".flytri-{:08x}", random())).string();
    // mkstemp would give the owner alone access, and umask() cannot be read beside other threads.
    descriptor = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) return write_failure(path, errno);
  take_over_permissions(descriptor, path);
  return AtomicFile(path, std::move(temporary), descriptor);
}

Result<void> AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return write_failure(path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> AtomicFile::commit() {
  // Some file systems find out that the disk is full only here.
  if (::fsync(descriptor_) != 0) return write_failure(path_, errno);
  if (Result<void> renamed = commit_unsynced(); !renamed) return renamed;
  return sync_folder_of(path_);
}

Result<void> AtomicFile::commit_unsynced() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0 || ::rename(temporary_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary_.c_str());
    return write_failure(path_, error);
  }
  return {};
}

Result<void> check_writable(const fs::path& path) {
  return AtomicFile::create(path).map([](const AtomicFile&) {});
}

Result<void> write_file(const fs::path& path, std::string_view bytes) {
  Result<AtomicFile> file = AtomicFile::create(path);
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

namespace {

Result<std::string> read_descriptor(int descriptor, const fs::path& path) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return read_failure(path, errno);
  if (S_ISDIR(status.st_mode)) return read_failure(path, EISDIR);
  if (!S_ISREG(status.st_mode)) {
    return fail(ErrorCode::kBadFormat, "{}: is not a regular file", path.string());
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

Result<std::string> read_file(const fs::path& path) {
  // Not blocking: a pipe in the place of a file is refused, not waited for.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return read_failure(path, errno);
  Result<std::string> bytes = read_descriptor(descriptor, path);
  ::close(descriptor);
  return bytes;
}

Result<void> create_private_file(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0 && errno == EEXIST) {
    return fail(ErrorCode::kBadOption, "{}: exists already; choose another name", path.string());
  }
  if (descriptor < 0) return write_failure(path, errno);
  ::close(descriptor);
  return {};
}

Result<void> create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return write_failure(folder, error.value());
  return {};
}

}  // namespace flytri::io
