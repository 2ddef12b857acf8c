#include "app/session/case_events.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <array>
#include <ctime>

#include "core/base/iso_time.h"

namespace flytri::session {
namespace {

/// The name of the account, or its number where it has no name. Not what the environment says.
std::string user_name() {
  std::array<char, 4096> texts = {};
  passwd entry = {};
  passwd* found = nullptr;
  const uid_t user = ::geteuid();
  if (::getpwuid_r(user, &entry, texts.data(), texts.size(), &found) == 0 && found != nullptr) {
    return entry.pw_name;
  }
  return fmt::format("user {}", user);
}

std::string host_name() {
  std::array<char, 256> name = {};
  const bool is_known = ::gethostname(name.data(), name.size() - 1) == 0 && name.front() != '\0';
  return is_known ? name.data() : "unknown";
}

}  // namespace

io::CaseEvent event_now(io::CaseAction action, std::optional<io::ScanStage> stage,
                        const std::vector<std::filesystem::path>& files) {
  io::CaseEvent event;
  event.action = action;
  event.time = iso_time(std::time(nullptr));
  event.user = user_name();
  event.host = host_name();
  event.program = "flytri " FLYTRI_VERSION;
  event.stage = stage;
  std::error_code ignored;
  for (const std::filesystem::path& file : files) {
    event.files.push_back(std::filesystem::absolute(file, ignored).string());
  }
  return event;
}

}  // namespace flytri::session
