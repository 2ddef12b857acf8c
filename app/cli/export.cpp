/// @file  flytri export: writes the finished model of a case to files; nothing is computed.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/case_access.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "core/io/files/file_bytes.h"
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
  bool force = false;
};

/// A case keeps models as .glb: writes those bytes, or converts them.
Result<void> write_kept(const fs::path& output, const std::string& glb, const std::string& name) {
  if (output.extension() == ".glb") return io::write_file(output, glb, io::Access::kOwnerOnly);
  Result<TexturedMesh> model = io::parse_glb(glb, name);
  if (!model) return tl::unexpected(model.error());
  if (!io::holds_texture(output)) texture::color_vertices(*model);
  return io::write_model(output, *model);
}

/// Writes all outputs. @param written  gets those that are complete
Result<void> write_all(const std::vector<fs::path>& outputs, const std::string& glb,
                       const std::string& name, std::vector<fs::path>& written) {
  for (const fs::path& output : outputs) {
    if (auto done = write_kept(output, glb, name); !done) return done;
    written.push_back(output);
    print_out("wrote {}\n", output.string());
  }
  return {};
}

Result<void> export_from(const ExportArguments& arguments, CaseAccess& access) {
  Result<io::CaseFile> file = access.open(true);
  if (!file) return tl::unexpected(file.error());
  const Result<io::ScanStage> stage =
      choose_stage(*file, arguments.case_options, "a finished model",
                   [](const io::StageCounts& counts) { return counts.has_result; });
  if (!stage) {
    return fail(stage.error().code, "{}; make one with flytri reconstruct --keep",
                stage.error().message);
  }
  const Result<io::StageResult> result = file->load_result(*stage);
  if (!result) {
    return fail(result.error().code, "{}; make the model again with flytri reconstruct --keep",
                result.error().message);
  }
  std::vector<fs::path> written;
  Result<void> done =
      write_all(arguments.outputs, result->glb, arguments.case_path.string(), written);
  if (!written.empty()) access.note(io::CaseAction::kExported, *stage, written);
  return done;
}

Result<void> run(const ExportArguments& arguments) {
  if (auto checked = check_output_files(arguments.outputs, {}, arguments.force); !checked)
    return checked;
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  Result<void> done = export_from(arguments, *access);
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
  add_force_option(*command, arguments->force);
  command->footer("Example: flytri export smith.flytri --stage upper -o upper.glb");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::cli
