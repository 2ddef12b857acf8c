#include "app/cli/prompt.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>

#include "app/cli/console.h"

namespace flytri::cli {
namespace {

constexpr int kPatience_ms = 100;  // the longest delay until Ctrl-C is noticed

}  // namespace

std::optional<std::string> Prompt::ask(const std::string& question) {
  print_out("{}", question);
  std::fflush(stdout);
  while (!progress_.cancelled()) {
    if (const auto end = pending_.find('\n'); end != std::string::npos) {
      std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      return line;
    }
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, kPatience_ms) <= 0) continue;
    std::array<char, 256> bytes{};
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) return std::nullopt;
    pending_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return std::nullopt;
}

}  // namespace flytri::cli
