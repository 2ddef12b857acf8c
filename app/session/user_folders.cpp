#include "app/session/user_folders.h"

#include <cstdlib>
#include <optional>
#include <string>

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

/// The specification demands that relative paths are ignored.
std::optional<fs::path> absolute_path_in(const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr || !fs::path(value).is_absolute()) return std::nullopt;
  return value;
}

fs::path base(const char* variable, const char* fallback) {
  if (const auto path = absolute_path_in(variable)) return *path;
  // Debian's name for the home of users without one: nothing can be written there.
  return home_folder().value_or("/nonexistent") / fallback;
}

}  // namespace

Result<fs::path> home_folder() {
  if (auto home = absolute_path_in("HOME")) return *home;
  return fail(ErrorCode::kNotFound,
              "the variable HOME is not set, so there is no home folder; set HOME");
}

Result<void> check_user_folders() {
  if (absolute_path_in("HOME")) return {};
  for (const char* variable : {"XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME",
                               "XDG_STATE_HOME", "XDG_DOCUMENTS_DIR"}) {
    if (absolute_path_in(variable)) continue;
    return fail(ErrorCode::kNotFound,
                "there is no folder for settings, cases and exports, as the variable HOME is not "
                "set, nor {}; set HOME to your home folder",
                variable);
  }
  return {};
}

Result<fs::path> typed_folder(const std::string& typed, const ui::Texts& texts) {
  if (typed.empty()) {
    return fail(ErrorCode::kBadOption, "{}", texts.fill<ui::Text::kNoFolderGiven>("~/Documents"));
  }
  if (typed.front() != '~') return fs::path(typed);
  if (typed.size() > 1 && typed[1] != '/') {
    return fail(ErrorCode::kBadOption, "{}", texts.fill<ui::Text::kOnlyOwnHome>(typed));
  }
  return home_folder().map([&](const fs::path& home) {
    return typed.size() > 2 ? home / fs::path(typed.substr(2)).relative_path() : home;
  });
}

fs::path config_folder() { return base("XDG_CONFIG_HOME", ".config") / "flytri"; }
fs::path cache_folder() { return base("XDG_CACHE_HOME", ".cache") / "flytri"; }
fs::path data_folder() { return base("XDG_DATA_HOME", ".local/share") / "flytri"; }
fs::path recordings_folder() { return data_folder() / "recordings"; }

fs::path unnamed_cases_folder() {
  return base("XDG_STATE_HOME", ".local/state") / "flytri" / "unnamed";
}
fs::path documents_folder() { return base("XDG_DOCUMENTS_DIR", "Documents"); }

}  // namespace flytri::session
