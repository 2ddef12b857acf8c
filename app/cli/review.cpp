/// @file  flytri review: measures on a finished model: sections, undercuts, margin, distances.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/cli/case_access.h"
#include "app/cli/case_part.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/cli/review_measure.h"
#include "app/cli/review_report.h"
#include "app/cli/review_request.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"
#include "core/io/models/ply.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kMmOfMicron = 1e-3;

struct ReviewArguments {
  fs::path model;
  CaseArguments case_options;
  ReviewTexts texts;
  double radius_mm = 7.0;
  std::optional<double> sigma_um;
  fs::path report, lines, map;
  bool force = false;
  int thread_count = 0;
};

Result<ReviewRequest> check_review(const ReviewArguments& arguments) {
  auto request = parse_review(arguments.texts);
  if (!request) return request;
  if (!arguments.lines.empty() && !request->section && request->margin_mm.empty())
    return fail(ErrorCode::kBadOption,
                "--lines writes outlines and margin; add --section-plane or --margin");
  if (!arguments.lines.empty() && arguments.lines.extension() != ".obj")
    return fail(ErrorCode::kBadOption, "{}: lines are written as .obj", arguments.lines.string());
  if (!arguments.map.empty() && !request->axis)
    return fail(ErrorCode::kBadOption, "--undercut-map shows the undercut; add --axis");
  if (!arguments.map.empty() && arguments.map.extension() != ".ply")
    return fail(ErrorCode::kBadOption, "{}: the undercut map is written as .ply",
                arguments.map.string());
  auto checked = check_output_files(
      {}, {{arguments.report, kReviewFormat}, {arguments.lines, ".obj"}, {arguments.map, ".ply"}},
      arguments.force);
  if (!checked) return tl::unexpected(checked.error());
  return request;
}

/// Says where the uncertainty of the model's points is from.
ReviewedModel prepared(std::string name, const TriangleMesh& mesh,
                       const ReviewArguments& arguments) {
  ReviewedModel model{std::move(name), review::made_ready(mesh), "from the model"};
  if (arguments.sigma_um) {
    review::set_uncertainty(model.mesh, kMmOfMicron * *arguments.sigma_um);
    model.uncertainty = "as given by --sigma-um";
  } else if (!review::mark_unknown_uncertainty(model.mesh)) {
    model.uncertainty = "unknown: the model does not say it; give it with --sigma-um";
  }
  return model;
}

Result<void> write_review(const ReviewArguments& arguments, const Review& review,
                          std::vector<fs::path>& written) {
  const auto note = [&](const fs::path& path) {
    written.push_back(path);
    print_out("wrote {}\n", path.string());
  };
  if (!arguments.lines.empty()) {
    auto done = io::write_file(arguments.lines, review_lines(review), io::Access::kOwnerOnly);
    if (!done) return done;
    note(arguments.lines);
  }
  if (!arguments.map.empty()) {
    if (auto done = io::write_ply(arguments.map, undercut_map(*review.undercut)); !done)
      return done;
    note(arguments.map);
  }
  if (arguments.report.empty()) return {};
  auto done = io::write_file(arguments.report, review_text(review), io::Access::kOwnerOnly);
  if (done) note(arguments.report);
  return done;
}

Result<void> review_model(const ReviewArguments& arguments, const ReviewRequest& request,
                          const ReviewedModel& model, const Progress& progress,
                          std::vector<fs::path>& written) {
  if (model.mesh.triangles.empty())
    return fail(ErrorCode::kInsufficient, "{}: has no triangles; give a model with a surface",
                model.name);
  const auto review =
      review_of(model, {request, arguments.radius_mm, arguments.thread_count}, progress);
  if (!review) return tl::unexpected(review.error());
  print_review(*review);
  return write_review(arguments, *review, written);
}

Result<void> review_case(const ReviewArguments& arguments, const ReviewRequest& request,
                         const Progress& progress) {
  Result<CaseAccess> access = CaseAccess::begin(arguments.model, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  const auto review_stage = [&]() -> Result<void> {
    Result<io::CaseFile> file = access->open(true);
    if (!file) return tl::unexpected(file.error());
    const auto stage =
        choose_stage(*file, arguments.case_options, "a finished model",
                     [](const io::StageCounts& counts) { return counts.has_result; });
    if (!stage)
      return fail(stage.error().code, "{}; make one with flytri reconstruct --keep",
                  stage.error().message);
    const auto part = load_part(*file, *stage);
    if (!part) return tl::unexpected(part.error());
    std::vector<fs::path> written;
    Result<void> done = review_model(
        arguments, request, prepared(part->name, part->surface, arguments), progress, written);
    if (!written.empty()) access->note(io::CaseAction::kExported, *stage, written);
    return done;
  };
  Result<void> done = review_stage();
  access->write_notes();
  return done;
}

Result<void> run(const ReviewArguments& arguments, const Progress& progress) {
  const auto request = check_review(arguments);
  if (!request) return tl::unexpected(request.error());
  if (arguments.model.extension() == ".flytri") return review_case(arguments, *request, progress);
  const auto model = io::read_model(arguments.model);
  if (!model) return tl::unexpected(model.error());
  std::vector<fs::path> written;
  return review_model(arguments, *request,
                      prepared(arguments.model.string(), model->mesh, arguments), progress,
                      written);
}

void add_measure_options(CLI::App& command, ReviewArguments& arguments) {
  ReviewTexts& texts = arguments.texts;
  command.add_option("--section-plane", texts.section_plane,
                     "Cut the model: \"X,Y,Z NX,NY,NZ\", a point of the plane and its normal");
  command.add_option("--section-points", texts.section_points,
                     "Measure on the section, straight and along it: \"X,Y,Z X,Y,Z\", two points "
                     "near it");
  command.add_option(
      "--axis", texts.axis,
      "Find undercuts against this insertion axis: X,Y,Z from the tooth outwards, or "
      "auto: the axis with the least undercut");
  command.add_option("--around", texts.around,
                     "Only this part of the model: X,Y,Z, a point on the prepared tooth");
  command.add_option("--radius-mm", arguments.radius_mm, "How much around it, mm")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command
      .add_option("--margin", texts.margin,
                  "Draw the margin line: \"X,Y,Z X,Y,Z X,Y,Z ...\", three or more points within "
                  "0.5 mm of the edge, in order; may be given several times")
      ->allow_extra_args(false);
  command
      .add_option("--distance", texts.distances,
                  "Distance of two points: \"X,Y,Z X,Y,Z\"; may be given several times")
      ->allow_extra_args(false);
  command
      .add_option(
          "--angle", texts.angles,
          "Angle at the second of three points: \"X,Y,Z X,Y,Z X,Y,Z\"; may be given several "
          "times")
      ->allow_extra_args(false);
  command
      .add_option("--sigma-um", arguments.sigma_um,
                  "Standard uncertainty of the model's points, µm. Default: what the model says")
      ->check(CLI::Range(0.0, 1e4));
}

}  // namespace

void add_review_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ReviewArguments>();
  CLI::App* command = app.add_subcommand(
      "review", "Measure on a finished model: section, undercut, margin line, distances");
  command
      ->add_option("MODEL", arguments->model,
                   fmt::format("A model ({}), or a case (.flytri) with a finished one; all points "
                               "are in its frame, mm",
                               io::extension_list(io::FormatUse::kRead)))
      ->required();
  add_measure_options(*command, *arguments);
  command->add_option("-o,--report", arguments->report, "Write all numbers and lines as .json");
  command->add_option("--lines", arguments->lines, "Write outlines and margin as lines: .obj");
  command->add_option("--undercut-map", arguments->map,
                      "Write the surface, redder where it is more undercut: .ply");
  add_case_options(*command, arguments->case_options);
  add_force_option(*command, arguments->force);
  add_threads_option(*command, arguments->thread_count);
  command->footer(
      "Example: flytri review upper.ply --around 2,1,5 --axis auto "
      "--margin \"5,1,2 2,5,2 -1,1,2 2,-3,2\" -o review.json --lines margin.obj");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
