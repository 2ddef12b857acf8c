#include "core/io/files/secret_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "core/io/files/file_errors.h"

namespace flytri::io {
namespace {

constexpr std::size_t kLongest = 1000;

/// Reads up to `size` bytes, or to the end. @return  how many, or minus an errno
ssize_t read_start(int descriptor, char* bytes, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(descriptor, bytes + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -errno;
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return static_cast<ssize_t>(done);
}

}  // namespace

Result<Secret> read_secret(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return read_failure(path, errno);
  Secret secret;
  char* const bytes = secret.buffer(kLongest + 2);
  const ssize_t count = read_start(descriptor, bytes, kLongest + 1);
  ::close(descriptor);
  if (count < 0) return read_failure(path, static_cast<int>(-count));
  const auto size = static_cast<std::size_t>(count);
  const std::size_t line = std::string_view(bytes, size).find_first_of("\r\n");
  const std::size_t length = std::min(line, size);
  if (length > kLongest || std::memchr(bytes, 0, length) != nullptr) {
    return fail(ErrorCode::kBadFormat,
                "{}: its first line is no passphrase: it is longer than {} bytes, or has a zero "
                "byte",
                path.string(), kLongest);
  }
  wipe(bytes + length, size - length);
  return secret;
}

}  // namespace flytri::io
