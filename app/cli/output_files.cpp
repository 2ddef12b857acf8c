#include "app/cli/output_files.h"

#include <array>
#include <map>
#include <utility>

#include "core/io/files/file_bytes.h"
#include "core/io/files/former_file.h"
#include "core/io/files/leftovers.h"
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

Result<void> check_file(const OtherOutput& output, bool force) {
  if (auto checked = io::check_writable(output.path); !checked) return checked;
  io::remove_leftovers(output.path.parent_path());
  return check_replaceable(output, force);
}

}  // namespace

void add_force_option(CLI::App& command, bool& force) {
  command.add_flag("--force", force,
                   "Replace files that exist; those of another kind are never replaced");
}

Result<void> check_replaceable(const OtherOutput& output, bool force) {
  switch (io::former_at(output.path, output.kind)) {
    case io::Former::kNothing:
      return {};
    case io::Former::kSameKind:
      if (force) return {};
      return fail(ErrorCode::kBadOption,
                  "{}: exists already; choose another name, or replace it with --force",
                  output.path.string());
    case io::Former::kOtherKind:
      break;
  }
  return io::other_kind(output.path, output.kind);
}

Result<void> check_output_files(const std::vector<fs::path>& models,
                                const std::vector<OtherOutput>& others, bool force) {
  Claims claims;
  for (const fs::path& model : models) {
    if (auto checked = io::check_model_path(model); !checked) return checked;
    for (const fs::path& file : io::files_of_model(model)) {
      if (auto claimed = claims.claim(file, model); !claimed) return claimed;
      if (auto checked = check_file({file, io::kind_by_name(file)}, force); !checked)
        return checked;
    }
  }
  for (const OtherOutput& other : others) {
    if (other.path.empty()) continue;
    if (auto claimed = claims.claim(other.path, other.path); !claimed) return claimed;
    if (auto checked = check_file(other, force); !checked) return checked;
  }
  return {};
}

Result<void> check_recording_folder(const fs::path& folder, bool force) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kFiles = {
      {{"recording.json", "flytri.recording"},
       {"frames/000000.png", ".png"},
       {"truth.json", "flytri.truth"},
       {"model.ply", ".ply"}}};
  for (const auto& [name, kind] : kFiles) {
    if (auto checked = check_replaceable({folder / name, kind}, force); !checked) return checked;
  }
  return {};
}

std::string model_output_help() {
  return fmt::format("Model to write: {}; may be given several times",
                     io::extension_list(io::FormatUse::kWrite));
}

}  // namespace flytri::cli
