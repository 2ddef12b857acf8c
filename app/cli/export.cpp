/// @file  flytri export: writes the finished model of a case to files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/cli/case_access.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/density_option.h"
#include "app/cli/export_jaws.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "app/cli/review_request.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/io/models/model.h"
#include "core/reconstruct/margin_files.h"
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
  std::string plane;  ///< three points; empty: as the case says
  bool force = false;
};

/// The kept model as it is written. A case keeps models as .glb, in full.
struct KeptModel {
  const std::string& glb;
  std::string name;  ///< of the case, for messages
  std::vector<io::StoredMargin> margins;
};

/// The margin lines as text, and the files that hold it: one for each name of a model.
struct MarginFiles {
  std::string text;
  std::set<fs::path> files;
};

/// @errors  As check_output_files, for the files of the margin lines.
Result<MarginFiles> margin_files(const ExportArguments& arguments, const TriangleMesh& model,
                                 const KeptModel& kept) {
  const reconstruct::MarginLines margins = reconstruct::margins_on(model, kept.margins, Workers());
  if (margins.outdated > 0) {
    print_error(
        "flytri: warning: margin lines left out: {}. They were drawn on an older model, and the "
        "edge is no longer there; draw them again in the window\n",
        margins.outdated);
  }
  MarginFiles found;
  if (margins.lines.empty()) return found;
  found.text = reconstruct::margins_obj(margins.lines);
  std::vector<OtherOutput> others;
  for (const fs::path& output : arguments.outputs) {
    const auto [file, is_new] = found.files.insert(reconstruct::margin_file_of(output));
    if (is_new) others.push_back({*file, ".obj"});
  }
  if (auto checked = check_output_files(arguments.outputs, others, arguments.force); !checked)
    return tl::unexpected(checked.error());
  return found;
}

Result<void> write_margins(const MarginFiles& margins, std::vector<fs::path>& written) {
  for (const fs::path& file : margins.files) {
    auto done = io::write_file(file, margins.text, io::Access::kOwnerOnly);
    if (!done) return done;
    written.push_back(file);
    print_out("wrote {}\n", file.string());
  }
  return {};
}

/// Writes all outputs. @param written  gets those that are complete
Result<void> write_all(const ExportArguments& arguments, const KeptModel& kept,
                       const Progress& progress, std::vector<fs::path>& written) {
  Result<TexturedMesh> model = io::parse_glb(kept.glb, kept.name);
  if (!model) return tl::unexpected(model.error());
  const Result<MarginFiles> margins = margin_files(arguments, model->mesh, kept);
  if (!margins) return tl::unexpected(margins.error());
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
  return write_margins(*margins, written);
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
  auto margins = file->load_margins(*stage);
  if (!margins) return tl::unexpected(margins.error());
  std::vector<fs::path> written;
  Result<void> done =
      write_all(arguments, {result->glb, arguments.case_path.string(), *std::move(margins)},
                progress, written);
  if (!written.empty()) access.note(io::CaseAction::kExported, *stage, written);
  return done;
}

Result<std::optional<OcclusalPoints>> plane_of(const std::string& text) {
  constexpr auto kOption = "--occlusal-plane";
  std::optional<OcclusalPoints> plane;
  if (text.empty()) return plane;
  const auto points = parse_points(text, kOption);
  if (!points) return tl::unexpected(points.error());
  plane.emplace();
  if (points->size() != plane->size()) {
    return fail(ErrorCode::kBadOption,
                "{}: {} points are given, 3 are needed: \"X,Y,Z X,Y,Z X,Y,Z\"", kOption,
                points->size());
  }
  std::copy(points->begin(), points->end(), plane->begin());
  return plane;
}

Result<void> run_on_jaws(const ExportArguments& arguments, const Progress& progress) {
  if (!arguments.case_options.stage.empty())
    return fail(ErrorCode::kBadOption,
                "--jaws and --stage: --jaws writes all stages; leave one out");
  const auto plane = plane_of(arguments.plane);
  if (!plane) return tl::unexpected(plane.error());
  for (const fs::path& output : arguments.outputs) {
    if (auto checked = io::check_model_path(output); !checked) return checked;
  }
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  Result<void> done = export_jaws({arguments.outputs, arguments.density, arguments.force, *plane},
                                  *access, progress);
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
  CLI::Option* const jaws = command->add_flag(
      "--jaws", arguments->all_jaws,
      "All jaws in one frame, as they bite: NAME.glb holds all, NAME.stl becomes NAME-upper.stl, "
      "NAME-lower.stl, NAME-bite.stl and so on");
  command
      ->add_option("--occlusal-plane", arguments->plane,
                   "Three points that set the occlusal plane: \"X,Y,Z X,Y,Z X,Y,Z\", mm, in the "
                   "world of the upper jaw, or of the lower one if it is alone. Default: as it was "
                   "set in the window, or else found")
      ->needs(jaws);
  add_density_option(*command, arguments->density);
  add_force_option(*command, arguments->force);
  command->footer("Example: flytri export smith.flytri --stage upper -o upper.glb");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
