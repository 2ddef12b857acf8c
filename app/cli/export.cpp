/// @file  flytri export: the finished model of a case to a file, without computing anything.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/case_argument.h"
#include "app/cli/commands.h"
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
};

/// The bytes as they are kept, or the model in another format.
Result<void> write_kept(const fs::path& output, const std::string& glb, const std::string& name) {
  if (output.extension() == ".glb") return io::write_file(output, glb);
  Result<TexturedMesh> model = io::parse_glb(glb, name);
  if (!model) return tl::unexpected(model.error());
  if (!io::carries_atlas(output)) texture::color_vertices(*model);
  return io::write_model(output, *model);
}

Result<void> run(const ExportArguments& arguments) {
  for (const fs::path& output : arguments.outputs) {
    if (auto checked = io::check_model_path(output); !checked) return checked;
  }
  Result<io::CaseFile> file = open_case(arguments.case_path, arguments.case_options, true);
  if (!file) return tl::unexpected(file.error());
  const Result<io::ScanStage> stage =
      choose_stage(*file, arguments.case_options, "a finished model",
                   [](const io::StageCounts& counts) { return counts.has_result; });
  if (!stage) {
    return fail(stage.error().code, "{}; flytri reconstruct computes one", stage.error().message);
  }
  const Result<io::StageResult> result = file->load_result(*stage);
  if (!result) {
    return fail(result.error().code, "{}; flytri reconstruct computes it again",
                result.error().message);
  }
  for (const fs::path& output : arguments.outputs) {
    auto written = write_kept(output, result->glb, arguments.case_path.string());
    if (!written) return written;
    fmt::print("wrote {}\n", output.string());
  }
  return {};
}

}  // namespace

void add_export_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand("export", "Write the finished model of a case");
  command->add_option("CASE", arguments->case_path, "A case (.flytri)")->required();
  command
      ->add_option("-o,--output", arguments->outputs,
                   "Model to write: .glb, .ply, .stl or .obj; may be given several times")
      ->required();
  add_case_options(*command, arguments->case_options);
  command->footer("Example: flytri export smith.flytri --stage upper -o upper.glb");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::cli
