#include "ui/gpu/asset_path.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace flytri::ui {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> asset_folders() {
  if (const char* folder = std::getenv("FLYTRI_ASSETS")) return {folder};
  std::error_code error;
  std::vector<fs::path> folders;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(program.parent_path().parent_path() / "share/flytri");
  return folders;
}

}  // namespace

Result<fs::path> asset_path(std::string_view name) {
  std::string tried;
  std::error_code error;
  for (const fs::path& folder : asset_folders()) {
    fs::path path = folder / name;
    if (fs::exists(path, error)) return path;
    tried += (tried.empty() ? "" : " and ") + folder.string();
  }
  return fail(ErrorCode::kNotFound,
              "{} is missing; looked in {}. Install the program anew, or set FLYTRI_ASSETS to the "
              "folder that holds it",
              name, tried);
}

Result<std::string> read_asset(std::string_view name) {
  const Result<fs::path> path = asset_path(name);
  if (!path) return tl::unexpected(path.error());
  std::ifstream file(*path, std::ios::binary);
  if (!file) {
    return fail(ErrorCode::kNotPermitted, "{} cannot be read; check its permissions",
                path->string());
  }
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace flytri::ui
