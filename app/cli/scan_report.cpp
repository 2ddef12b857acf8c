/// @file  flytri report: says how much a finished scan of a case is worth.
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/case_access.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/report/span_json.h"
#include "app/report/write_report.h"
#include "core/base/iso_time.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/models/glb.h"
#include "core/reconstruct/finish_scan.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct ScanReportArguments {
  fs::path case_path;
  CaseArguments case_options;
  std::vector<fs::path> outputs;
  bool force = false;
};

void count_frames(const io::StoredStage& stage, report::ScanFacts& facts) {
  facts.registered = stage.texture_frames.size();
  for (const io::StoredView& view : stage.views) {
    if (view.T_world_sensor) {
      ++facts.registered;
    } else {
      ++facts.rejected["was not registered"];
    }
  }
  for (const io::StoredFrame& frame : stage.frames) {
    if (!frame.reason.empty()) ++facts.rejected[frame.reason];
  }
}

/// What the case knows about a stage and its model.
Result<report::ScanFacts> facts_in(io::CaseFile& file, io::ScanStage stage) {
  constexpr const char* kRemedy = "make the model again with flytri reconstruct --keep";
  const auto result = file.load_result(stage);
  if (!result) return fail(result.error().code, "{}; {}", result.error().message, kRemedy);
  const auto counts = file.counts(stage);
  if (!counts) return tl::unexpected(counts.error());
  const auto stored = file.load_stage(stage);
  if (!stored) return tl::unexpected(stored.error());
  print_damage(stored->damage);
  if (result->made_of && *result->made_of != io::basis_of(*counts, stored->edits.state())) {
    return fail(ErrorCode::kInconsistent,
                "{}: the {} stage was scanned or edited since its model was made; {}",
                file.path().string(), to_string(stage), kRemedy);
  }
  Result<TexturedMesh> model = io::parse_glb(result->glb, file.path().string());
  if (!model) return tl::unexpected(model.error());
  const auto fields = file.fields();
  if (!fields) return tl::unexpected(fields.error());
  report::ScanFacts facts;
  facts.source = file.path().string();
  facts.patient = *fields;
  facts.stage = stage;
  facts.surface = reconstruct::finished_scan_of(*std::move(model)).surface;
  facts.spans = report::spans_in(result->summary_json);
  count_frames(*stored, facts);
  facts.edits = report::count_edits(stored->edits.state());
  const auto calibration = file.calibration().and_then(
      [&](const std::string& json) { return io::parse_calibration(json, file.path().string()); });
  if (calibration) facts.calibration = report::facts_of(*calibration);
  facts.made_at = iso_time(std::time(nullptr));
  facts.program = "flytri " FLYTRI_VERSION;
  return facts;
}

Result<void> report_on(const ScanReportArguments& arguments, CaseAccess& access) {
  Result<io::CaseFile> file = access.open(true);
  if (!file) return tl::unexpected(file.error());
  const Result<io::ScanStage> stage = choose_finished_stage(*file, arguments.case_options);
  if (!stage) return tl::unexpected(stage.error());
  const auto facts = facts_in(*file, *stage);
  if (!facts) return tl::unexpected(facts.error());
  std::vector<fs::path> written;
  Result<void> done;
  for (const fs::path& output : arguments.outputs) {
    done = report::write_report(output, *facts);
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
