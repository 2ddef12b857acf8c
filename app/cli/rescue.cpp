/// @file  flytri rescue: copies what can be read of a damaged case to a new one.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/cli/case_access.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"

namespace flytri::cli {
namespace {

struct RescueArguments {
  std::filesystem::path case_path;
  std::filesystem::path output;
  CaseArguments case_options;
};

/// "upper: 37 views, 4 texture images, 1 distance, a finished model"
std::string text_of(io::ScanStage stage, const io::StageCounts& counts) {
  std::string text = fmt::format("{}: {} views, {} texture images", to_string(stage), counts.views,
                                 counts.texture_frames);
  if (counts.measurements > 0) text += fmt::format(", {} distances", counts.measurements);
  if (counts.has_result) text += ", a finished model";
  return text;
}

Result<void> run(const RescueArguments& arguments) {
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  // The journal gets no note: nothing is written to a damaged case.
  Result<io::CaseFile> file = access->open(true);
  if (!file) return tl::unexpected(file.error());
  const std::size_t told = file->damage().size();
  const Result<io::CaseSurvey> rescued = file->rescue_to(arguments.output);
  if (!rescued) return tl::unexpected(rescued.error());
  print_damage({rescued->lost.begin() + static_cast<std::ptrdiff_t>(told), rescued->lost.end()});
  for (const io::ScanStage stage : io::kScanStages) {
    const io::StageCounts& counts = rescued->readable[static_cast<std::size_t>(stage)];
    if (counts == io::StageCounts{}) continue;
    print_out("{}\n", text_of(stage, counts));
  }
  print_out("wrote {}{}\n", arguments.output.string(),
            rescued->lost.empty() ? "; nothing was damaged" : "");
  return {};
}

}  // namespace

void add_rescue_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<RescueArguments>();
  CLI::App* command =
      app.add_subcommand("rescue", "Copy what can be read of a damaged case to a new case");
  command->add_option("CASE", arguments->case_path, "The damaged case (.flytri); it stays as it is")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "The new case, encrypted like the old one; it must not exist")
      ->required();
  add_passphrase_option(*command, arguments->case_options);
  command->footer("Example: flytri rescue smith.flytri -o smith-rescued.flytri");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::cli
