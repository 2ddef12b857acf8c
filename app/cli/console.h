/// @file  Prints to the terminal. A terminal that is gone, or a full disk behind it, ends no job.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/result.h"

namespace flytri::cli {

/// The text with control characters written as \n or \x1b. Names in files of strangers could
/// otherwise change what the terminal shows.
[[nodiscard]] std::string printable(std::string_view text);

/// Writes text as it is. Failures are remembered by the stream, see finish_output().
void write_raw(std::FILE* stream, std::string_view text);

/// @errors  kWriteFailed: something that was printed did not arrive.
[[nodiscard]] Result<void> finish_output();

namespace internal {

template <typename T>
inline constexpr bool kIsText = std::is_convertible_v<const T&, std::string_view>;

template <typename T>
using Shown = std::conditional_t<kIsText<T>, std::string, const T&>;

template <typename T>
Shown<T> shown(const T& value) {
  if constexpr (kIsText<T>) {
    return printable(value);
  } else {
    return value;
  }
}

}  // namespace internal

/// As fmt::print to a stream; texts among the arguments are made printable().
template <typename... Args>
void print_to(std::FILE* stream, fmt::format_string<internal::Shown<Args>...> format,
              const Args&... args) {
  write_raw(stream, fmt::format(format, internal::shown(args)...));
}

/// Prints results.
template <typename... Args>
void print_out(fmt::format_string<internal::Shown<Args>...> format, const Args&... args) {
  print_to<Args...>(stdout, format, args...);
}

/// Prints messages and progress.
template <typename... Args>
void print_error(fmt::format_string<internal::Shown<Args>...> format, const Args&... args) {
  print_to<Args...>(stderr, format, args...);
}

}  // namespace flytri::cli
