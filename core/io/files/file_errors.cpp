#include "core/io/files/file_errors.h"

#include <cerrno>
#include <string_view>
#include <system_error>

namespace flytri::io {
namespace {

std::string_view remedy_of_writing(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "; free some space or choose another folder";
    case EFBIG:
      return "; the file is larger than the file system or your account allows; choose another "
             "folder";
    case EACCES:
    case EPERM:
      return "; change the permissions or choose another folder";
    case EROFS:
      return "; the disk is read-only; choose another folder";
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
      return "; give the path of a file";
    default:
      return "";
  }
}

ErrorCode code_of(int error, ErrorCode otherwise) {
  if (error == EACCES || error == EPERM || error == EROFS) return ErrorCode::kNotPermitted;
  if (error == ENOENT || error == ENOTDIR) return ErrorCode::kNotFound;
  return otherwise;
}

}  // namespace

tl::unexpected<Error> write_failure(const std::filesystem::path& path, int error) {
  return fail(code_of(error, ErrorCode::kWriteFailed), "{}: cannot be written: {}{}", path.string(),
              std::generic_category().message(error), remedy_of_writing(error));
}

tl::unexpected<Error> read_failure(const std::filesystem::path& path, int error) {
  return fail(code_of(error, ErrorCode::kBadFormat), "{}: cannot be read: {}{}", path.string(),
              std::generic_category().message(error), remedy_of_reading(error));
}

tl::unexpected<Error> file_exists(const std::filesystem::path& path) {
  return fail(ErrorCode::kBadOption, "{}: exists already; choose another name", path.string());
}

}  // namespace flytri::io
