#include "app/cli/case_argument.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include "app/cli/console.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void add_case_options(CLI::App& command, CaseArguments& arguments) {
  std::vector<std::string> names;
  names.reserve(io::kScanStages.size());
  for (const io::ScanStage stage : io::kScanStages) names.emplace_back(to_string(stage));
  command
      .add_option("--stage", arguments.stage,
                  "For a case: " + io::stage_names() + "; needed if several were scanned")
      ->check(CLI::IsMember(names));
  add_passphrase_option(command, arguments);
}

void add_passphrase_option(CLI::App& command, CaseArguments& arguments) {
  command.add_option("--passphrase-file", arguments.passphrase_file,
                     "For an encrypted case: file whose first line is the passphrase. Default: the "
                     "environment variable FLYTRI_PASSPHRASE");
}

bool names_case(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) || path.extension() == ".flytri";
}

void print_damage(const std::vector<std::string>& damage) {
  for (const std::string& what : damage) print_error("flytri: lost: {}\n", what);
}

Result<io::ScanStage> choose_stage(io::CaseFile& file, const CaseArguments& arguments,
                                   const std::string& what,
                                   const std::function<bool(const io::StageCounts&)>& has) {
  std::optional<io::ScanStage> chosen;
  std::vector<std::string> candidates;
  for (const io::ScanStage stage : io::kScanStages) {
    const Result<io::StageCounts> counts = file.counts(stage);
    if (!counts) return tl::unexpected(counts.error());
    if (!has(*counts)) continue;
    candidates.emplace_back(to_string(stage));
    chosen = stage;
  }
  const std::optional<io::ScanStage> asked = io::stage_named(arguments.stage);
  if (asked &&
      std::find(candidates.begin(), candidates.end(), arguments.stage) == candidates.end()) {
    return fail(ErrorCode::kInsufficient, "{}: the stage {} has no {}; the stages with {}: {}",
                file.path().string(), arguments.stage, what, what, joined(candidates));
  }
  if (asked) return *asked;
  if (candidates.size() == 1) return *chosen;
  if (candidates.empty()) {
    return fail(ErrorCode::kInsufficient, "{}: no stage has {}", file.path().string(), what);
  }
  return fail(ErrorCode::kBadOption, "{}: several stages have {}: {}; choose one with --stage",
              file.path().string(), what, joined(candidates));
}

Result<io::ScanStage> choose_finished_stage(io::CaseFile& file, const CaseArguments& arguments) {
  Result<io::ScanStage> stage =
      choose_stage(file, arguments, "a finished model",
                   [](const io::StageCounts& counts) { return counts.has_result; });
  if (stage) return stage;
  return fail(stage.error().code, "{}; make one with flytri reconstruct --keep",
              stage.error().message);
}

}  // namespace flytri::cli
