/// @file  flytri report: says how much a finished scan of a case is worth.
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/case_access.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/report/case_facts.h"
#include "app/report/write_report.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct ScanReportArguments {
  fs::path case_path;
  CaseArguments case_options;
  std::vector<fs::path> outputs;
  bool force = false;
};

Result<void> report_on(const ScanReportArguments& arguments, CaseAccess& access) {
  Result<io::CaseFile> file = access.open(true);
  if (!file) return tl::unexpected(file.error());
  const Result<io::ScanStage> stage = choose_finished_stage(*file, arguments.case_options);
  if (!stage) return tl::unexpected(stage.error());
  const auto found = report::facts_in(*file, *stage);
  if (!found) return tl::unexpected(found.error());
  print_damage(found->damage);
  std::vector<fs::path> written;
  Result<void> done;
  for (const fs::path& output : arguments.outputs) {
    done = report::write_report(output, found->facts);
    if (!done) break;
    written.push_back(output);
    print_out("wrote {}\n", output.string());
  }
  if (!written.empty()) access.note(io::CaseAction::kExported, *stage, written);
  return done;
}

Result<void> run(const ScanReportArguments& arguments) {
  std::vector<std::string> kinds;
  std::vector<OtherOutput> others;
  kinds.reserve(arguments.outputs.size());
  for (const fs::path& output : arguments.outputs) {
    auto kind = report::report_kind(output);
    if (!kind) return tl::unexpected(kind.error());
    kinds.push_back(*std::move(kind));
    others.push_back({output, kinds.back()});
  }
  if (auto checked = check_output_files({}, others, arguments.force); !checked) return checked;
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  Result<void> done = report_on(arguments, *access);
  access->write_notes();
  return done;
}

}  // namespace

void add_report_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ScanReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Write how certain, how complete and how edited a finished scan of a case is");
  command->add_option("CASE", arguments->case_path, "A case (.flytri)")->required();
  command
      ->add_option("-o,--output", arguments->outputs,
                   "Report to write: .html or .json; may be given several times")
      ->required();
  add_case_options(*command, arguments->case_options);
  add_force_option(*command, arguments->force);
  command->footer("Example: flytri report smith.flytri --stage upper -o upper.html");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::cli
