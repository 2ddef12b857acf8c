/// @file  flytri evaluate: compares a model with the truth of a simulated recording.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "core/evaluation/best_fit.h"
#include "core/evaluation/color_error.h"
#include "core/evaluation/delta_e.h"
#include "core/evaluation/pose_error.h"
#include "core/evaluation/surface_error.h"
#include "core/io/calibrations/recording_calibration.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"
#include "core/io/models/ply.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "core/measurement/measure_view.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "flytri.evaluation";
constexpr double kMicronsOfMm = 1e3;
/// A place counts as seen by both patterns if points of both are this near; a multiple of
/// complete_within_mm.
constexpr double kCrossedWithin = 3.0;
/// A vertex this close to a true one has its color. Smaller than a painted spot.
constexpr double kColorWithinMm = 0.3;
constexpr double kPercent = 1e2;

struct EvaluateArguments {
  fs::path result;
  fs::path recording;
  fs::path calibration;
  fs::path report;
  fs::path output;
  bool force = false;
  evaluation::SurfaceErrorOptions surface;
  int thread_count = 0;

  [[nodiscard]] fs::path truth_file() const { return recording / "truth.json"; }
  [[nodiscard]] double crossed_within_mm() const {
    return kCrossedWithin * surface.complete_within_mm;
  }
};

/// The true surface, and which of its vertices the sensor could measure.
struct TrueSurface {
  TriangleMesh mesh;
  std::vector<bool> selected;  ///< empty: all
  std::vector<bool> crossed;   ///< those where lines of both patterns were; empty: not known
};

/// What the model is compared with.
struct Reference {
  TrueSurface surface;
  Isometry T_model_world = Isometry::Identity();   ///< by the first registered view
  std::vector<evaluation::PosePair> registered;    ///< poses; empty without a report
  std::vector<evaluation::PosePair> interpolated;  ///< those of texture frames among them
  std::optional<Vec3> volume_mm;                   ///< of the sensor, if the report has it
};

struct Evaluation {
  evaluation::SurfaceError as_it_stands;
  evaluation::SurfaceError fitted;
  std::optional<evaluation::Completeness> crossed;  ///< where lines of both patterns were
  evaluation::BestFitOutcome outcome = evaluation::BestFitOutcome::kStillMoving;
  evaluation::ColorError colors;
  evaluation::DeltaE delta_e = {};
  std::size_t registered_count = 0, interpolated_count = 0;  ///< poses
  std::optional<evaluation::PoseError> registered = std::nullopt;
  double interpolated_mm = 0.0;  ///< in the gauge of the first view
};

Result<TrueSurface> read_true_surface(const fs::path& path) {
  auto ply = io::read_ply(path);
  if (!ply) return tl::unexpected(ply.error());
  TrueSurface surface;
  if (const auto lit = ply->extra.find("lit"); lit != ply->extra.end()) {
    for (const double value : lit->second) surface.selected.push_back(value > 0.0);
  }
  surface.mesh = std::move(ply->mesh);
  return surface;
}

Result<Isometry> true_pose(const EvaluateArguments& arguments, const io::Truth& truth,
                           FrameIndex frame) {
  const auto found = std::find_if(truth.poses.begin(), truth.poses.end(),
                                  [&](const io::TruthPose& pose) { return pose.frame == frame; });
  if (found != truth.poses.end()) return found->T_model_sensor;
  return fail(ErrorCode::kInconsistent,
              "{}: no pose for frame {}; give the recording that the model was made from",
              arguments.truth_file().string(), frame.value);
}

Result<FrameIndex> first_measurement_frame(const io::Recording& recording) {
  const auto found = std::find_if(
      recording.frames.begin(), recording.frames.end(),
      [](const io::RecordedFrame& frame) { return frame.kind != FrameKind::kTexture; });
  if (found != recording.frames.end()) {
    return FrameIndex(static_cast<int>(found - recording.frames.begin()));
  }
  return fail(ErrorCode::kInsufficient, "{}: no frame shows lines; record again",
              (recording.folder / "recording.json").string());
}

Result<void> pair_poses(const EvaluateArguments& arguments, const io::Truth& truth,
                        const std::vector<ReportedPose>& reported, Reference& reference) {
  for (const ReportedPose& pose : reported) {
    const auto T_model_sensor = true_pose(arguments, truth, pose.frame);
    if (!T_model_sensor) return tl::unexpected(T_model_sensor.error());
    (pose.registered ? reference.registered : reference.interpolated)
        .push_back({pose.T_world_sensor, *T_model_sensor});
  }
  return {};
}

/// Without a report: assumes that the first measurement frame was registered first.
Result<void> guess_gauge(const EvaluateArguments& arguments, const io::Truth& truth,
                         Reference& reference) {
  const auto recording = io::open_recording(arguments.recording);
  if (!recording) return tl::unexpected(recording.error());
  const auto first = first_measurement_frame(*recording);
  if (!first) return tl::unexpected(first.error());
  const auto T_model_sensor = true_pose(arguments, truth, *first);
  if (!T_model_sensor) return tl::unexpected(T_model_sensor.error());
  reference.T_model_world = *T_model_sensor;
  return {};
}

/// Fills in the gauge, and with a report the pairs of poses.
Result<void> read_gauge(const EvaluateArguments& arguments, const io::Truth& truth,
                        Reference& reference) {
  if (arguments.report.empty()) return guess_gauge(arguments, truth, reference);
  const auto report = read_report(arguments.report);
  if (!report) return tl::unexpected(report.error());
  if (auto paired = pair_poses(arguments, truth, report->poses, reference); !paired) return paired;
  const evaluation::PosePair& first = reference.registered.front();
  reference.T_model_world = first.T_model_sensor * first.T_world_sensor.inverse();
  reference.volume_mm = report->volume_mm;
  return {};
}

/// Only simulated recordings have a truth.
Result<io::Truth> read_truth_of(const EvaluateArguments& arguments) {
  auto truth = io::read_truth(arguments.truth_file());
  if (truth || truth.error().code != ErrorCode::kNotFound) return truth;
  return fail(ErrorCode::kNotFound,
              "{}: not found; only simulated recordings have a truth: give the folder of one with "
              "--recording, or make one with flytri simulate recording",
              arguments.truth_file().string());
}

/// The views of the recording at their true poses. A frame that cannot be measured has none.
Result<std::vector<AlignedView>> true_views(const EvaluateArguments& arguments,
                                            const io::Truth& truth, const io::Recording& recording,
                                            const calibration::Calibration& calibration,
                                            const Workers& workers, const Progress& progress) {
  std::vector<std::shared_ptr<const View>> views(recording.frames.size());
  progress.begin_stage("Measuring the frames");
  const auto measure = [&](std::size_t i) {
    if (recording.frames[i].kind == FrameKind::kTexture) return;
    const auto frame = io::load_frame(recording, FrameIndex(i));
    if (!frame) return;
    auto measured = measurement::measure_view(*frame, calibration, {});
    if (measured) views[i] = std::make_shared<const View>(std::move(measured->view));
  };
  if (!workers.for_each_unless_cancelled(views.size(), measure, progress)) return stopped();
  std::vector<AlignedView> aligned;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i] == nullptr) continue;
    const auto T_model_sensor = true_pose(arguments, truth, FrameIndex(i));
    if (!T_model_sensor) return tl::unexpected(T_model_sensor.error());
    aligned.push_back({views[i], *T_model_sensor});
  }
  return aligned;
}

/// Marks the measurable vertices where lines of both patterns were; none without a calibration.
Result<void> find_crossed(const EvaluateArguments& arguments, const io::Truth& truth,
                          TrueSurface& surface, const Workers& workers, const Progress& progress) {
  const auto recording = io::open_recording(arguments.recording);
  if (!recording) return tl::unexpected(recording.error());
  if (arguments.calibration.empty() && !recording->calibration) return {};
  const auto used = io::calibration_of(*recording, arguments.calibration);
  if (!used && arguments.calibration.empty()) {
    print_error("flytri: warning: {}; completeness by both patterns is left out\n",
                used.error().message);
    return {};
  }
  if (!used) return tl::unexpected(used.error());
  const auto views = true_views(arguments, truth, *recording, used->calibration, workers, progress);
  if (!views) return tl::unexpected(views.error());
  surface.crossed =
      evaluation::crossed_vertices(surface.mesh, *views, arguments.crossed_within_mm(), workers);
  for (std::size_t i = 0; i < surface.selected.size(); ++i) {
    if (!surface.selected[i]) surface.crossed[i] = false;
  }
  return {};
}

Result<Reference> read_reference(const EvaluateArguments& arguments, const Workers& workers,
                                 const Progress& progress) {
  const auto truth = read_truth_of(arguments);
  if (!truth) return tl::unexpected(truth.error());
  Reference reference;
  if (auto read = read_gauge(arguments, *truth, reference); !read) {
    return tl::unexpected(read.error());
  }
  auto surface = read_true_surface(truth->mesh);
  if (!surface) return tl::unexpected(surface.error());
  reference.surface = std::move(*surface);
  auto found = find_crossed(arguments, *truth, reference.surface, workers, progress);
  if (!found) return tl::unexpected(found.error());
  return reference;
}

Result<Evaluation> evaluate(const TexturedMesh& result, const Reference& reference,
                            const EvaluateArguments& arguments, const Workers& workers,
                            const Progress& progress) {
  const TrueSurface& truth = reference.surface;
  const auto error_of = [&](const TriangleMesh& mesh) {
    return evaluation::surface_error(mesh, truth.mesh, truth.selected, arguments.surface, workers);
  };
  progress.begin_stage("Comparing", 3);
  const TriangleMesh placed = evaluation::transformed(result.mesh, reference.T_model_world);
  const auto as_it_stands = error_of(placed);
  if (!as_it_stands) return tl::unexpected(as_it_stands.error());
  progress.advance();
  const auto fit = evaluation::best_fit(placed, truth.mesh, {}, workers);
  if (!fit) return tl::unexpected(fit.error());
  progress.advance();
  const auto fitted = error_of(evaluation::transformed(placed, fit->T_truth_result));
  if (!fitted) return tl::unexpected(fitted.error());
  progress.advance();
  const evaluation::ColorError colors = evaluation::color_error(
      {placed, result.uv, result.atlas}, truth.mesh, kColorWithinMm, workers);
  Evaluation evaluation{*as_it_stands, *fitted, std::nullopt, fit->outcome, colors};
  if (!truth.crossed.empty()) {
    evaluation.crossed = evaluation::completeness(placed, truth.mesh, truth.crossed,
                                                  arguments.surface.complete_within_mm, workers);
  }
  evaluation.delta_e =
      evaluation::delta_e({placed, result.uv, result.atlas}, truth.mesh, kColorWithinMm, workers);
  evaluation.registered_count = reference.registered.size();
  evaluation.interpolated_count = reference.interpolated.size();
  if (reference.registered.empty() || !reference.volume_mm) return evaluation;
  const std::vector<Vec3> corners = evaluation::volume_corners(*reference.volume_mm);
  evaluation.registered = evaluation::pose_error(reference.registered, corners);
  evaluation.interpolated_mm =
      evaluation::pose_error_mm(reference.interpolated, reference.T_model_world, corners);
  return evaluation;
}

void print_row(std::string_view gauge, const evaluation::SurfaceError& error) {
  const evaluation::DistanceStatistics& d = error.distance;
  print_out("{:<14}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.0f}{:>9.3f}{:>10.2f}{:>10.2f}\n", gauge,
            kMicronsOfMm * d.rms_mm, kMicronsOfMm * d.mean_mm, kMicronsOfMm * d.median_mm,
            kMicronsOfMm * d.percentile_95_mm, kMicronsOfMm * d.max_mm, kPercent * error.far_share,
            kPercent * error.completeness.near_surface, kPercent * error.completeness.near_vertex);
}

void print_poses(const Evaluation& evaluation) {
  if (!evaluation.registered) {
    print_out(
        "\nno errors of the poses: the report has no measurement volume; write it again with "
        "flytri reconstruct --report\n");
    return;
  }
  print_out(
      "\nposes, RMS at the corners of the measurement volume: {} registered {:.1f} µm by the first "
      "view, {:.1f} µm at best fit",
      evaluation.registered_count, kMicronsOfMm * evaluation.registered->first_view_mm,
      kMicronsOfMm * evaluation.registered->best_fit_mm);
  if (evaluation.interpolated_count > 0) {
    print_out("; {} interpolated {:.1f} µm by the first view", evaluation.interpolated_count,
              kMicronsOfMm * evaluation.interpolated_mm);
  }
  print_out("\n");
}

void print_evaluation(const Evaluation& evaluation, const EvaluateArguments& arguments) {
  print_out("{} vertices compared with the true surface, which has {} vertices to find\n\n",
            evaluation.as_it_stands.distance.count, evaluation.as_it_stands.completeness.selected);
  print_out("{:<14}{:^45}{:>9}  {}\n", "", "distance, µm",
            fmt::format(">{:g} mm", arguments.surface.far_above_mm),
            fmt::format("complete to {:g} mm", arguments.surface.complete_within_mm));
  print_out("{:<14}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>10}{:>10}\n", "gauge", "RMS", "mean", "median",
            "95 %", "max", "%", "surf. %", "vert. %");
  print_row("as it stands", evaluation.as_it_stands);
  print_row("best fit", evaluation.fitted);
  if (evaluation.crossed) {
    print_out("Of {} vertices with lines of both patterns within {:g} mm, {:.2f} % are complete.\n",
              evaluation.crossed->selected, arguments.crossed_within_mm(),
              kPercent * evaluation.crossed->near_surface);
  }
  if (evaluation.outcome == evaluation::BestFitOutcome::kStillMoving) {
    print_out("The best fit did not converge: it was still moving after its last step.\n");
  }
  print_out(
      "\ncolor, difference in chromaticity from the nearest true vertex: median {:.3f}, "
      "95 % {:.3f} (by chance {:.3f}); difference in sRGB 0..255, with brightness: mean {:.1f}\n",
      evaluation.colors.median, evaluation.colors.percentile_95, evaluation.colors.median_by_chance,
      evaluation.colors.mean_srgb);
  print_out(
      "color, difference dE76 from the true surface after one gain ({:.3f}): median {:.2f}, 95 % "
      "{:.2f}\n",
      evaluation.delta_e.gain, evaluation.delta_e.median, evaluation.delta_e.percentile_95);
  if (evaluation.registered_count > 0) print_poses(evaluation);
}

Json surface_json(const evaluation::SurfaceError& error) {
  const evaluation::DistanceStatistics& d = error.distance;
  return {{"rms_mm", d.rms_mm},
          {"mean_mm", d.mean_mm},
          {"median_mm", d.median_mm},
          {"percentile_95_mm", d.percentile_95_mm},
          {"max_mm", d.max_mm},
          {"far_share", error.far_share},
          {"complete_surface_share", error.completeness.near_surface},
          {"complete_vertex_share", error.completeness.near_vertex}};
}

Json to_json(const Evaluation& evaluation, const EvaluateArguments& arguments) {
  Json json = {{"format", kFormat},
               {"version", 1},
               {"vertices", evaluation.as_it_stands.distance.count},
               {"true_vertices", evaluation.as_it_stands.completeness.selected},
               {"far_above_mm", arguments.surface.far_above_mm},
               {"complete_within_mm", arguments.surface.complete_within_mm},
               {"as_it_stands", surface_json(evaluation.as_it_stands)},
               {"best_fit", surface_json(evaluation.fitted)}};
  if (evaluation.crossed) {
    json["crossed"] = {{"within_mm", arguments.crossed_within_mm()},
                       {"true_vertices", evaluation.crossed->selected},
                       {"complete_surface_share", evaluation.crossed->near_surface},
                       {"complete_vertex_share", evaluation.crossed->near_vertex}};
  }
  json["best_fit"]["converged"] = evaluation.outcome == evaluation::BestFitOutcome::kConverged;
  json["color"] = {{"vertices", evaluation.colors.count},
                   {"median", evaluation.colors.median},
                   {"percentile_95", evaluation.colors.percentile_95},
                   {"median_by_chance", evaluation.colors.median_by_chance},
                   {"mean_srgb", evaluation.colors.mean_srgb},
                   {"delta_e76_median", evaluation.delta_e.median},
                   {"delta_e76_percentile_95", evaluation.delta_e.percentile_95},
                   {"delta_e76_gain", evaluation.delta_e.gain}};
  if (evaluation.registered) {
    json["poses"] = {{"registered", evaluation.registered_count},
                     {"first_view_rms_mm", evaluation.registered->first_view_mm},
                     {"best_fit_rms_mm", evaluation.registered->best_fit_mm},
                     {"interpolated", evaluation.interpolated_count},
                     {"interpolated_first_view_rms_mm", evaluation.interpolated_mm}};
  }
  return json;
}

Result<void> run(const EvaluateArguments& arguments, const Progress& progress) {
  auto checked = check_output_files({}, {{arguments.output, kFormat}}, arguments.force);
  if (!checked) return checked;
  const auto model = io::read_model(arguments.result);
  if (!model) return tl::unexpected(model.error());
  const Workers workers(arguments.thread_count);
  const auto reference = read_reference(arguments, workers, progress);
  if (!reference) return tl::unexpected(reference.error());
  const auto evaluation = evaluate(*model, *reference, arguments, workers, progress);
  if (!evaluation) return tl::unexpected(evaluation.error());
  print_evaluation(*evaluation, arguments);
  if (arguments.output.empty()) return {};
  auto written = io::write_file(arguments.output, to_json(*evaluation, arguments).dump(1) + "\n");
  if (written) print_out("wrote {}\n", arguments.output.string());
  return written;
}

}  // namespace

void add_evaluate_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate", "Compare a model with the true surface of a simulated recording");
  command
      ->add_option("RESULT", arguments->result,
                   fmt::format("Model: {}", io::extension_list(io::FormatUse::kRead)))
      ->required();
  command
      ->add_option("--recording", arguments->recording,
                   "Folder of the simulated recording, with recording.json and truth.json")
      ->required();
  command->add_option("--calibration", arguments->calibration,
                      "Adds how complete the surface is where lines of both patterns were; "
                      "needed only if recording.json does not name it");
  command->add_option(
      "--report", arguments->report,
      "report.json of the reconstruction: says which view was registered first, and "
      "adds the errors of the poses");
  command->add_option("-o,--output", arguments->output, "Also write the figures as .json");
  add_force_option(*command, arguments->force);
  command
      ->add_option("--complete-within", arguments->surface.complete_within_mm,
                   "The true surface counts as found up to this distance, mm")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--far-above", arguments->surface.far_above_mm,
                   "A vertex counts as far off above this distance, mm")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_threads_option(*command, arguments->thread_count);
  command->footer(
      "Example: flytri evaluate upper.glb --recording scans/upper --report report.json -o "
      "evaluation.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
