/// @file  flytri export: writes the finished model of a case to files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/case_access.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/density_option.h"
#include "app/cli/export_jaws.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "core/io/models/glb.h"
#include "core/io/models/model.h"
#include "core/texture/vertex_colors.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  fs::path case_path;
  CaseArguments case_options;
  std::vector<fs::path> outputs;
  reconstruct::MeshDensity density = reconstruct::MeshDensity::kCad;
  bool all_jaws = false;
  bool force = false;
};

/// The kept model as it is written. A case keeps models as .glb, in full.
struct KeptModel {
  const std::string& glb;
  std::string name;  ///< of the case, for messages
};

/// Writes all outputs. @param written  gets those that are complete
Result<void> write_all(const ExportArguments& arguments, const KeptModel& kept,
                       const Progress& progress, std::vector<fs::path>& written) {
  Result<TexturedMesh> model = io::parse_glb(kept.glb, kept.name);
  if (!model) return tl::unexpected(model.error());
  texture::color_vertices(*model);
  if (arguments.density != reconstruct::MeshDensity::kFull)
    progress.begin_stage(reconstruct::kThinningTriangles);
  Result<reconstruct::ModelAtDensity> lighter =
      reconstruct::at_density(*model, arguments.density, progress);
  if (!lighter) return tl::unexpected(lighter.error());
  print_density(*lighter);
  for (const fs::path& output : arguments.outputs) {
    if (auto done = io::write_model(output, lighter->model, lighter->uncut); !done) return done;
    written.push_back(output);
    print_out("wrote {}\n", output.string());
  }
  return {};
}

Result<void> export_from(const ExportArguments& arguments, CaseAccess& access,
                         const Progress& progress) {
  Result<io::CaseFile> file = access.open(true);
  if (!file) return tl::unexpected(file.error());
  const Result<io::ScanStage> stage = choose_finished_stage(*file, arguments.case_options);
  if (!stage) return tl::unexpected(stage.error());
  const Result<io::StageResult> result = file->load_result(*stage);
  if (!result) {
    return fail(result.error().code, "{}; make the model again with flytri reconstruct --keep",
                result.error().message);
  }
  std::vector<fs::path> written;
  Result<void> done =
      write_all(arguments, {result->glb, arguments.case_path.string()}, progress, written);
  if (!written.empty()) access.note(io::CaseAction::kExported, *stage, written);
  return done;
}

Result<void> run_on_jaws(const ExportArguments& arguments, const Progress& progress) {
  if (!arguments.case_options.stage.empty())
    return fail(ErrorCode::kBadOption,
                "--jaws and --stage: --jaws writes all stages; leave one out");
  for (const fs::path& output : arguments.outputs) {
    if (auto checked = io::check_model_path(output); !checked) return checked;
  }
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  Result<void> done =
      export_jaws({arguments.outputs, arguments.density, arguments.force}, *access, progress);
  access->write_notes();
  return done;
}

Result<void> run(const ExportArguments& arguments, const Progress& progress) {
  if (arguments.all_jaws) return run_on_jaws(arguments, progress);
  if (auto checked = check_output_files(arguments.outputs, {}, arguments.force); !checked)
    return checked;
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  Result<void> done = export_from(arguments, *access, progress);
  access->write_notes();
  return done;
}

}  // namespace

void add_export_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand("export", "Write the finished model of a case");
  command->add_option("CASE", arguments->case_path, "A case (.flytri)")->required();
  command->add_option("-o,--output", arguments->outputs, model_output_help())->required();
  add_case_options(*command, arguments->case_options);
  command->add_flag("--jaws", arguments->all_jaws,
                    "All jaws in one frame, as they bite: NAME.glb holds all, NAME.stl becomes "
                    "NAME-upper.stl, NAME-lower.stl, NAME-bite.stl and so on");
  add_density_option(*command, arguments->density);
  add_force_option(*command, arguments->force);
  command->footer("Example: flytri export smith.flytri --stage upper -o upper.glb");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
