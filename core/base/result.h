/// @file  Result<T>: a value, or the Error that a function failed with.
#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace flytri {

/// Kind of a failure. The list is complete: callers may switch over it.
enum class ErrorCode {
  kBadOption,     ///< an option or argument is out of its range
  kNotFound,      ///< a file, folder or device does not exist
  kNotPermitted,  ///< it exists, but must not be read or written
  kBadFormat,     ///< a file is damaged, truncated, of an unknown version or of another format
  kInconsistent,  ///< each input is valid, but they do not fit each other
  kInsufficient,  ///< too little data
  kWriteFailed,   ///< writing failed, for example: disk full; no partial file stays
  kCancelled,     ///< stopped by the user
};

/// An expected failure. The message says what happened, where, and what to do.
struct Error {
  ErrorCode code;
  std::string message;
};

template <typename T>
using Result = tl::expected<T, Error>;

/// Makes the error of any Result. The message is formatted by fmt.
template <typename... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> format,
                                         Args&&... args) {
  return tl::unexpected(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

}  // namespace flytri
