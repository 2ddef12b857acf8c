#include "app/session/user_folders.h"

#include <cstdlib>
#include <string>

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

fs::path home() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) : fs::temp_directory_path();
}

/// The specification demands that relative paths are ignored.
fs::path base(const char* variable, const char* fallback) {
  const char* value = std::getenv(variable);
  if (value != nullptr && fs::path(value).is_absolute()) return value;
  return home() / fallback;
}

}  // namespace

fs::path config_folder() { return base("XDG_CONFIG_HOME", ".config") / "flytri"; }
fs::path cache_folder() { return base("XDG_CACHE_HOME", ".cache") / "flytri"; }
fs::path data_folder() { return base("XDG_DATA_HOME", ".local/share") / "flytri"; }
fs::path unnamed_cases_folder() {
  return base("XDG_STATE_HOME", ".local/state") / "flytri" / "unnamed";
}
fs::path documents_folder() { return base("XDG_DOCUMENTS_DIR", "Documents"); }

}  // namespace flytri::session
