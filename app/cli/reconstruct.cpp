/// @file  flytri reconstruct: makes models from a recording or a case.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/cli/case_access.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/density_option.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "app/report/write_report.h"
#include "app/session/case_events.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/calibrations/recording_calibration.h"
#include "core/io/files/former_file.h"
#include "core/io/models/glb.h"
#include "core/io/models/ply.h"
#include "core/io/recordings/recording.h"
#include "core/reconstruct/reconstruct.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct ReconstructArguments {
  fs::path input;  ///< recording or case
  CaseArguments case_options;
  bool keep = false;
  bool as_measured = false;
  bool force = false;
  std::vector<fs::path> outputs;
  fs::path calibration;
  std::vector<fs::path> reports;
  fs::path points;
  reconstruct::MeshDensity density = reconstruct::MeshDensity::kFull;
  double close_holes_mm = 0.0;
  int thread_count = 0;
};

/// What was reconstructed.
struct Origin {
  const calibration::Calibration& calibration;
  editing::EditList edits = editing::EditStack().state();
  std::optional<io::CaseFields> patient = std::nullopt;
  std::optional<io::ScanStage> stage = std::nullopt;
};

bool is_page(const fs::path& path) { return io::kind_by_name(path) == ".html"; }

report::ScanFacts facts_of(const ReconstructArguments& arguments, const Origin& origin,
                           const reconstruct::Reconstruction& reconstruction) {
  report::ScanFacts facts = report::facts_now(arguments.input);
  facts.patient = origin.patient;
  facts.stage = origin.stage;
  facts.surface = reconstruction.surface;
  facts.spans = reconstruction.spans;
  for (const reconstruct::FrameReport& frame : reconstruction.frames) {
    if (frame.fate == reconstruct::FrameFate::kRejected) {
      ++facts.rejected[frame.reason];
    } else {
      ++facts.registered;
    }
  }
  facts.edits = report::count_edits(origin.edits);
  facts.calibration = report::facts_of(origin.calibration);
  facts.volume_mm = origin.calibration.volume.size_mm;
  return facts;
}

/// @param written  gets the files that are complete
Result<void> write_outputs(const ReconstructArguments& arguments,
                           const reconstruct::Reconstruction& reconstruction, const Origin& origin,
                           const Progress& progress, std::vector<fs::path>& written) {
  progress.begin_stage(reconstruct::kThinningTriangles);
  const Result<reconstruct::ModelAtDensity> model =
      reconstruct::at_density(reconstruction.model, arguments.density, progress);
  if (!model) return tl::unexpected(model.error());
  print_density(*model);
  const auto note = [&](const fs::path& file) {
    written.push_back(file);
    print_out("wrote {}\n", file.string());
  };
  for (const fs::path& output : arguments.outputs) {
    if (auto done = io::write_model(output, model->model, model->uncut); !done) return done;
    note(output);
  }
  if (!arguments.points.empty()) {
    auto done = io::write_point_cloud_ply(arguments.points, reconstruction.points);
    if (!done) return done;
    note(arguments.points);
  }
  for (const fs::path& path : arguments.reports) {
    auto done =
        is_page(path)
            ? report::write_report(path, facts_of(arguments, origin, reconstruction))
            : write_report(path, {reconstruction, *model, origin.calibration.volume.size_mm});
    if (!done) return done;
    note(path);
  }
  return {};
}

void print_warning(const std::string& warning) {
  if (!warning.empty()) print_error("flytri: warning: {}\n", warning);
}

reconstruct::ReconstructOptions options_of(const ReconstructArguments& arguments,
                                           std::optional<JawKind> jaw = std::nullopt) {
  reconstruct::ReconstructOptions options;
  options.finish.jaw = jaw;
  options.finish.meshing.close_holes_mm = arguments.close_holes_mm;
  options.finish.correct_projectors = !arguments.as_measured;
  options.finish.correct_rolling_shutter = !arguments.as_measured;
  options.now_s = steady_seconds;
  return options;
}

Result<void> run_on_recording(const ReconstructArguments& arguments, const Progress& progress) {
  if (arguments.keep) {
    return fail(ErrorCode::kBadOption, "--keep: {} is a recording; only a case can keep a model",
                arguments.input.string());
  }
  const Result<io::Recording> recording = io::open_recording(arguments.input);
  if (!recording) return tl::unexpected(recording.error());
  const auto used = io::calibration_of(*recording, arguments.calibration);
  if (!used) return tl::unexpected(used.error());
  print_warning(used->warning);
  const Result<reconstruct::Reconstruction> reconstruction =
      reconstruct::reconstruct(*recording, used->calibration, options_of(arguments),
                               Workers(arguments.thread_count), progress);
  if (!reconstruction) return tl::unexpected(reconstruction.error());
  print_summary(*reconstruction, used->calibration.volume.size_mm);
  std::vector<fs::path> written;
  return write_outputs(arguments, *reconstruction, {used->calibration}, progress, written);
}

/// The calibration given with --calibration, or else the one that the case keeps.
Result<calibration::Calibration> case_calibration(const ReconstructArguments& arguments,
                                                  io::CaseFile& file) {
  auto kept = file.calibration().and_then([&](const std::string& json) {
    return io::parse_calibration(json, arguments.input.string());
  });
  if (arguments.calibration.empty()) {
    if (kept) return kept;
    return fail(kept.error().code, "{}; --calibration FILE overrides it", kept.error().message);
  }
  auto chosen = io::read_calibration(arguments.calibration);
  if (chosen && kept && io::fingerprint(*chosen) != io::fingerprint(*kept)) {
    print_warning(fmt::format("{}: is not the calibration that {} was scanned with",
                              arguments.calibration.string(), arguments.input.string()));
  }
  return chosen;
}

/// The views that a reconstruction placed. Empty if the stage had poses: these stay.
std::vector<AlignedView> newly_placed(const io::StoredStage& stored,
                                      const reconstruct::Reconstruction& reconstruction) {
  std::map<FrameIndex, Isometry> poses;
  for (const reconstruct::FrameReport& report : reconstruction.frames) {
    if (report.T_world_sensor) poses[report.frame] = *report.T_world_sensor;
  }
  std::vector<AlignedView> placed;
  for (const io::StoredView& view : stored.views) {
    if (view.T_world_sensor) return {};
    const auto pose = poses.find(view.view->frame);
    if (pose != poses.end()) placed.push_back({view.view, pose->second});
  }
  return placed;
}

/// Saves the model in the case, for flytri export and for the window. New poses are saved with it,
/// so that the model and the stage share one world frame.
Result<void> keep_result(io::CaseFile& file, io::ScanStage stage, const io::StoredStage& stored,
                         const reconstruct::Reconstruction& reconstruction,
                         const calibration::MeasurementVolume& volume) {
  const Result<std::string> glb = io::encode_glb(reconstruction.model, file.path().string());
  if (!glb) return tl::unexpected(glb.error());
  const Result<io::StageCounts> counts = file.counts(stage);
  if (!counts) return tl::unexpected(counts.error());
  const auto full = reconstruct::at_density(reconstruction.model, reconstruct::MeshDensity::kFull);
  if (!full) return tl::unexpected(full.error());
  const io::StageResult result{*glb, report_text({reconstruction, *full, volume.size_mm}),
                               io::basis_of(*counts, stored.edits.state()), reconstruction.held};
  return file.write_poses(stage, newly_placed(stored, reconstruction))
      .and_then([&] { return file.write_result(stage, result); })
      .and_then(
          [&] { return file.add_event(session::event_now(io::CaseAction::kComputed, stage)); })
      .and_then([&] { return file.commit(); });
}

Result<void> reconstruct_case(const ReconstructArguments& arguments, CaseAccess& access,
                              const Progress& progress) {
  Result<io::CaseFile> file = access.open(!arguments.keep);
  if (!file) return tl::unexpected(file.error());
  const Result<io::ScanStage> stage =
      choose_stage(*file, arguments.case_options, "views",
                   [](const io::StageCounts& counts) { return counts.views > 0; });
  if (!stage) return tl::unexpected(stage.error());
  const Result<calibration::Calibration> calibration = case_calibration(arguments, *file);
  if (!calibration) return tl::unexpected(calibration.error());
  Result<io::StoredStage> stored = file->load_stage(*stage);
  if (!stored) return tl::unexpected(stored.error());
  print_damage(stored->damage);
  const reconstruct::NamedStage named{arguments.input.string(), *std::move(stored)};
  const Result<reconstruct::Reconstruction> reconstruction = reconstruct::reconstruct_stage(
      named, *calibration, options_of(arguments, reconstruct::jaw_of(*stage)),
      Workers(arguments.thread_count), progress);
  if (!reconstruction) return tl::unexpected(reconstruction.error());
  print_summary(*reconstruction, calibration->volume.size_mm);
  if (arguments.keep) {
    auto kept = keep_result(*file, *stage, named.stage, *reconstruction, calibration->volume);
    if (!kept) return kept;
  }
  std::vector<fs::path> written;
  Origin origin = {*calibration, named.stage.edits.state(),
                   file->fields().value_or(io::CaseFields{}), *stage};
  Result<void> done = write_outputs(arguments, *reconstruction, origin, progress, written);
  if (!written.empty()) access.note(io::CaseAction::kExported, *stage, written);
  return done;
}

Result<void> run_on_case(const ReconstructArguments& arguments, const Progress& progress) {
  Result<CaseAccess> access = CaseAccess::begin(arguments.input, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  Result<void> done = reconstruct_case(arguments, *access, progress);
  access->write_notes();
  return done;
}

Result<void> run(const ReconstructArguments& arguments, const Progress& progress) {
  std::vector<OtherOutput> others = {{arguments.points, ".ply"}};
  for (const fs::path& report : arguments.reports) {
    others.push_back({report, is_page(report) ? ".html" : kReportFormat});
  }
  auto checked = check_output_files(arguments.outputs, others, arguments.force);
  if (!checked) return checked;
  return names_case(arguments.input) ? run_on_case(arguments, progress)
                                     : run_on_recording(arguments, progress);
}

}  // namespace

void add_reconstruct_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ReconstructArguments>();
  CLI::App* command =
      app.add_subcommand("reconstruct", "Make a textured model from a recording or a case");
  command
      ->add_option("RECORDING", arguments->input, "Folder with recording.json, or a case (.flytri)")
      ->required();
  command->add_option("-o,--output", arguments->outputs, model_output_help())->required();
  command->add_option(
      "--calibration", arguments->calibration,
      "Calibration of the sensor. Default: the one that the recording names or the case keeps");
  command->add_option("--points", arguments->points, "Also write the thinned points as .ply");
  command->add_option("--report", arguments->reports,
                      "Also write a page about the scan, .html, or counts, poses, rates and times, "
                      ".json; may be given several times");
  add_case_options(*command, arguments->case_options);
  command->add_flag("--keep", arguments->keep,
                    "Also save the model in the case, for flytri export and the window");
  add_density_option(*command, arguments->density);
  command
      ->add_option("--close-holes", arguments->close_holes_mm,
                   "Close holes up to this width, mm, and mark them as not measured; 0: none")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_flag("--as-measured", arguments->as_measured,
                    "Do not correct the model for a projector that was knocked during the scan, or "
                    "for a rolling shutter");
  add_force_option(*command, arguments->force);
  add_threads_option(*command, arguments->thread_count);
  command->footer(
      "Example: flytri reconstruct scans/upper --calibration calibration.json -o upper.glb "
      "-o upper.stl --report report.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
