#include "app/cli/console.h"

#include <cerrno>
#include <system_error>

namespace flytri::cli {
namespace {

/// Control characters of ASCII, and those that UTF-8 writes as C2 80 to C2 9F.
bool is_control(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  if (byte < 0x20 || byte == 0x7f) return true;
  if (byte != 0xc2 || at + 1 == text.size()) return false;
  const auto next = static_cast<unsigned char>(text[at + 1]);
  return next >= 0x80 && next <= 0x9f;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_control(text, i)) {
      result += text[i];
    } else if (text[i] == '\n') {
      result += "\\n";
    } else {
      if (static_cast<unsigned char>(text[i]) == 0xc2) ++i;
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
    }
  }
  return result;
}

void write_raw(std::FILE* stream, std::string_view text) {
  (void)std::fwrite(text.data(), 1, text.size(), stream);
}

Result<void> finish_output() {
  errno = 0;
  const bool had_failed = std::ferror(stdout) != 0;
  if (std::fflush(stdout) == 0 && !had_failed) return {};
  return fail(ErrorCode::kWriteFailed,
              "not all of the output could be printed: {}; send it elsewhere",
              errno == 0 ? "the disk is full, or the terminal is gone"
                         : std::generic_category().message(errno));
}

}  // namespace flytri::cli
