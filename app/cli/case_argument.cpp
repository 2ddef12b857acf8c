#include "app/cli/case_argument.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <system_error>

#include "app/cli/console.h"
#include "core/io/files/file_bytes.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

/// The first line of a file.
Result<std::string> read_passphrase(const fs::path& path) {
  return io::read_file(path).map(
      [](const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); });
}

Result<std::string> passphrase_of(const CaseArguments& arguments) {
  if (!arguments.passphrase_file.empty()) return read_passphrase(arguments.passphrase_file);
  const char* const variable = std::getenv("FLYTRI_PASSPHRASE");
  return std::string(variable == nullptr ? "" : variable);
}

std::optional<io::ScanStage> stage_named(const std::string& name) {
  for (const io::ScanStage stage : io::kScanStages) {
    if (to_string(stage) == name) return stage;
  }
  return std::nullopt;
}

}  // namespace

void add_case_options(CLI::App& command, CaseArguments& arguments) {
  command
      .add_option("--stage", arguments.stage,
                  "For a case: upper, lower or bite; needed if several were scanned")
      ->check(CLI::IsMember({"upper", "lower", "bite"}));
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

Result<io::CaseFile> open_case(const fs::path& path, const CaseArguments& arguments,
                               bool read_only) {
  const Result<std::string> passphrase = passphrase_of(arguments);
  if (!passphrase) return tl::unexpected(passphrase.error());
  Result<io::CaseFile> file = io::CaseFile::open(path, {*passphrase, read_only});
  if (file) print_damage(file->damage());
  if (file || file.error().code != ErrorCode::kInconsistent) return file;
  return fail(ErrorCode::kInconsistent,
              "{}; put the passphrase into the variable FLYTRI_PASSPHRASE, or into a file for "
              "--passphrase-file",
              file.error().message);
}

void print_damage(const std::vector<std::string>& damage) {
  for (const std::string& what : damage) print_error("flytri: lost: {}\n", what);
}

Result<io::ScanStage> choose_stage(io::CaseFile& file, const CaseArguments& arguments,
                                   const std::string& what,
                                   const std::function<bool(const io::StageCounts&)>& has) {
  std::optional<io::ScanStage> chosen;
  std::string candidates;
  int count = 0;
  for (const io::ScanStage stage : io::kScanStages) {
    const Result<io::StageCounts> counts = file.counts(stage);
    if (!counts) return tl::unexpected(counts.error());
    if (!has(*counts)) continue;
    ++count;
    candidates += fmt::format("{}{}", candidates.empty() ? "" : ", ", to_string(stage));
    chosen = stage;
  }
  const std::optional<io::ScanStage> asked = stage_named(arguments.stage);
  if (asked && (candidates.empty() || candidates.find(arguments.stage) == std::string::npos)) {
    return fail(ErrorCode::kInsufficient, "{}: the stage {} has no {}; the stages with {}: {}",
                file.path().string(), arguments.stage, what, what,
                candidates.empty() ? "none" : candidates);
  }
  if (asked) return *asked;
  if (count == 1) return *chosen;
  if (count == 0) {
    return fail(ErrorCode::kInsufficient, "{}: no stage has {}", file.path().string(), what);
  }
  return fail(ErrorCode::kBadOption, "{}: several stages have {}: {}; choose one with --stage",
              file.path().string(), what, candidates);
}

}  // namespace flytri::cli
