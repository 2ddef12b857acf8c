#include "app/cli/output_files.h"

#include <map>
#include <utility>

#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

/// Which output writes which file.
class Claims {
 public:
  Result<void> claim(const fs::path& file, const fs::path& output) {
    std::error_code unknown;
    const fs::path place = fs::weakly_canonical(file, unknown);
    const auto [claimed, is_new] = outputs_.try_emplace(unknown ? file : place, output);
    if (is_new) return {};
    return fail(ErrorCode::kBadOption,
                "{}: two outputs would write this file: {} and {}; rename one of them",
                file.string(), claimed->second.string(), output.string());
  }

 private:
  std::map<fs::path, fs::path> outputs_;
};

}  // namespace

Result<void> check_output_files(const std::vector<fs::path>& models,
                                const std::vector<fs::path>& others) {
  Claims claims;
  for (const fs::path& model : models) {
    if (auto checked = io::check_model_path(model); !checked) return checked;
    if (auto checked = io::check_writable(model); !checked) return checked;
    for (const fs::path& file : io::files_of_model(model)) {
      if (auto claimed = claims.claim(file, model); !claimed) return claimed;
    }
  }
  for (const fs::path& other : others) {
    if (other.empty()) continue;
    if (auto checked = io::check_writable(other); !checked) return checked;
    if (auto claimed = claims.claim(other, other); !claimed) return claimed;
  }
  return {};
}

std::string model_output_help() {
  return fmt::format("Model to write: {}; may be given several times",
                     io::extension_list(io::FormatUse::kWrite));
}

}  // namespace flytri::cli
