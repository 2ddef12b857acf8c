/// @file  How functions say that they failed: Result<T> holds a value or an Error.
#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace flytri {

/// Why something could not be done. Closed: callers may switch over it.
enum class ErrorCode {
  kBadOption,     ///< an option or argument is out of its range
  kNotFound,      ///< a file, folder or device is not there
  kNotPermitted,  ///< it is there, but may not be read or written
  kBadFormat,     ///< a file is damaged, truncated, of an unknown version, or not what it claims
  kInconsistent,  ///< each input is fine alone, but they do not belong together
  kInsufficient,  ///< too little data for what was asked
  kWriteFailed,   ///< disk full or another failure while writing; nothing half-written stays
  kCancelled,     ///< stopped by the user
};

/// A failure that was to be expected. The message names the file, the place and the remedy.
struct Error {
  ErrorCode code;
  std::string message;
};

template <typename T>
using Result = tl::expected<T, Error>;

/// Makes the failing side of any Result; the message is formatted as fmt does.
template <typename... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> format,
                                         Args&&... args) {
  return tl::unexpected(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

}  // namespace flytri
