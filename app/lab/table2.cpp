/// @file  flytri-lab table2: the figures of the paper's Table 2, measured on simulated views.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "app/lab/simulated_scan.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/pose_error.h"
#include "core/io/files/file_bytes.h"
#include "core/refinement/refine.h"
#include "core/tracking/registrar.h"

namespace flytri::lab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Practically no noise, but above 0, so that weights are finite.
constexpr double kIdealSigmaMm = 1e-6;
/// Noise is correlated over this many neighboring rows, if speckle or smoothing correlates it.
constexpr double kCorrelationSamples = 1.5;

struct StudyArguments {
  fs::path output;
  bool force = false;
  int view_count = 1000;
  int thread_count = 0;
};

/// The results of one scan through the real pipeline.
struct ScanResult {
  std::size_t views = 0;
  std::size_t registered = 0;
  std::size_t points = 0;
  evaluation::PoseError live;  ///< after registration, before the joint refinement
  evaluation::PoseError refined;
  double live_point_error_mm = 0.0;  ///< with noise, best fit
  double refined_point_error_mm = 0.0;
  double registration_s = 0.0;
  double refinement_s = 0.0;
};

Result<ScanResult> run_scan(const TriangleMesh& jaw, const SimulatedScanOptions& options,
                            const Workers& workers, const Progress& progress) {
  const auto scan = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  ScanResult result;
  result.views = scan->views.size();
  for (const auto& view : scan->views) result.points += view->point_count();
  const double start_s = cli::steady_seconds();
  auto truth = register_scan(*scan, progress);
  if (!truth) return tl::unexpected(truth.error());
  result.registration_s = cli::steady_seconds() - start_s;
  result.registered = truth->aligned.size();
  result.live = evaluation::pose_error(truth->aligned, truth->T_model_sensor);
  result.live_point_error_mm =
      evaluation::point_error_mm(truth->aligned, truth->ideal, truth->T_model_sensor);
  const double refinement_start_s = cli::steady_seconds();
  progress.begin_stage("Optimizing together");
  const auto refinement = refinement::refine_jointly(truth->aligned, {}, workers, progress);
  if (!refinement) return tl::unexpected(refinement.error());
  result.refinement_s = cli::steady_seconds() - refinement_start_s;
  result.refined = evaluation::pose_error(truth->aligned, truth->T_model_sensor);
  result.refined_point_error_mm =
      evaluation::point_error_mm(truth->aligned, truth->ideal, truth->T_model_sensor);
  return result;
}

/// A row of the table, with the figure of the paper in µm.
struct PaperRow {
  std::string_view name;
  double paper_um;
  double best_fit_um;
  double first_view_um;  ///< NaN: not defined for this row
};

void print_row(const PaperRow& row) {
  const std::string first =
      std::isnan(row.first_view_um) ? "-" : fmt::format("{:.1f}", row.first_view_um);
  fmt::print("{:<46} {:>8.0f} {:>10.1f} {:>11}\n", row.name, row.paper_um, row.best_fit_um, first);
}

std::vector<PaperRow> rows_of(const ScanResult& noisy, const ScanResult& ideal) {
  const double none = std::nan("");
  return {{"real-time error (noise included)", 300, kMicrons * noisy.live_point_error_mm, none},
          {"real-time error (poses only)", 300, kMicrons * noisy.live.best_fit_mm,
           kMicrons * noisy.live.first_view_mm},
          {"final error (noise included)", 32, kMicrons * noisy.refined_point_error_mm, none},
          {"final error (noise removed)", 24, kMicrons * noisy.refined.best_fit_mm,
           kMicrons * noisy.refined.first_view_mm},
          {"final error (ideal data)", 5, kMicrons * ideal.refined.best_fit_mm,
           kMicrons * ideal.refined.first_view_mm}};
}

Json to_json(const std::string& noise, const ScanResult& noisy, const ScanResult& ideal) {
  Json rows = Json::array();
  for (const PaperRow& row : rows_of(noisy, ideal)) {
    Json entry = {{"name", row.name}, {"paper_um", row.paper_um}, {"best_fit_um", row.best_fit_um}};
    if (!std::isnan(row.first_view_um)) entry["first_view_um"] = row.first_view_um;
    rows.push_back(entry);
  }
  return {{"noise", noise},
          {"views", noisy.views},
          {"registered", noisy.registered},
          {"points", noisy.points},
          {"registration_s", noisy.registration_s},
          {"refinement_s", noisy.refinement_s},
          {"rows", rows}};
}

void print_table(std::string_view noise, const ScanResult& noisy, const ScanResult& ideal) {
  fmt::print(
      "\n{}: {} of {} views registered, {} points; registration {:.1f} s, refinement {:.1f} s\n",
      noise, noisy.registered, noisy.views, noisy.points, noisy.registration_s, noisy.refinement_s);
  fmt::print("{:<46} {:>8} {:>10} {:>11}\n", "error, µm", "paper", "best fit", "first view");
  for (const PaperRow& row : rows_of(noisy, ideal)) print_row(row);
}

Result<void> run(const StudyArguments& arguments, const Progress& progress) {
  auto checked = cli::check_output_files({}, {{arguments.output, "flytri.study"}}, arguments.force);
  if (!checked) return checked;
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  SimulatedScanOptions options;
  options.view_count = arguments.view_count;
  const auto scan_with = [&](double sigma_mm, double correlation_samples) {
    options.noise.sigma_mm = sigma_mm;
    options.noise.correlation_samples = correlation_samples;
    return run_scan(*jaw, options, workers, progress);
  };
  // The paper's 30 µm is a standard deviation along z.
  const auto ideal = scan_with(kIdealSigmaMm, 0.0);
  if (!ideal) return tl::unexpected(ideal.error());
  const auto white = scan_with(0.03, 0.0);
  if (!white) return tl::unexpected(white.error());
  const auto correlated = scan_with(0.03, kCorrelationSamples);
  if (!correlated) return tl::unexpected(correlated.error());
  const std::string correlated_name =
      fmt::format("30 µm, correlated over {} samples", kCorrelationSamples);
  print_table("30 µm, white", *white, *ideal);
  print_table(correlated_name, *correlated, *ideal);
  if (arguments.output.empty()) return {};
  const Json json = {
      {"format", "flytri.study"},
      {"version", 1},
      {"study", "table2"},
      {"scans",
       {to_json("30 µm, white", *white, *ideal), to_json(correlated_name, *correlated, *ideal)}}};
  return io::write_file(arguments.output, json.dump(1) + "\n");
}

}  // namespace

void add_table2_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = study.add_subcommand(
      "table2",
      "Measure the errors of the registration on simulated views of a dental arch (Table 2)");
  command->add_option("-o,--output", arguments->output, "Also write the figures as .json");
  cli::add_force_option(*command, arguments->force);
  command->add_option("--views", arguments->view_count, "Views to simulate")
      ->check(CLI::Range(20, 5000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab table2 -o table2.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
