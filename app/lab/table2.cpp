/// @file  flytri-lab table2: the figures of the paper's Table 2, measured on simulated views.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/lab/length_error.h"
#include "app/lab/plane_noise.h"
#include "app/lab/simulated_scan.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/base/median.h"
#include "core/evaluation/best_fit.h"
#include "core/evaluation/pose_error.h"
#include "core/evaluation/surface_error.h"
#include "core/normals/normals.h"
#include "core/reconstruct/jaw_spans.h"
#include "core/reduction/reduce.h"
#include "core/refinement/refine.h"

namespace flytri::lab {
namespace {

using Json = nlohmann::ordered_json;

struct Table2Arguments {
  SeedArguments seeds{{}, false, 1, 1, {}};
  int view_count = 1000;
  std::filesystem::path noise_from;
  int noise_exposures = 1;
  int thread_count = 0;
};

/// The paper's noise: a standard deviation along z.
constexpr double kSigma_mm = 0.03;
/// Practically no noise, but above 0, so that weights are finite.
constexpr double kIdealSigma_mm = 1e-6;
/// Noise is correlated over this many neighboring rows, if speckle or smoothing correlates it.
constexpr double kCorrelationSamples = 1.5;
/// Keys of a record with measured noise.
constexpr const char* kMeasured = "measured";
constexpr const char* kNoiseOfPlanes = "noise_of_planes";

/// RMS of the errors of neighboring views, µm: so many parts that a plot shows them.
Json over_views(const std::vector<double>& errors_mm) {
  constexpr std::size_t kMostParts = 100;
  const std::size_t parts = std::min(kMostParts, errors_mm.size());
  Json all = Json::array();
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * errors_mm.size() / parts;
    const std::size_t end = (part + 1) * errors_mm.size() / parts;
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += errors_mm[i] * errors_mm[i];
    all.push_back(kMicrons * std::sqrt(sum / static_cast<double>(end - begin)));
  }
  return all;
}

/// Errors of the points as they are now: with their noise, and by the poses alone.
Json pose_figures(const RegisteredTruth& truth) {
  const evaluation::PoseError poses = evaluation::pose_error(truth.aligned, truth.T_model_sensor);
  const double points_mm =
      evaluation::point_error_mm(truth.aligned, truth.ideal, truth.T_model_sensor);
  return {{"points_um", kMicrons * points_mm},
          {"best_fit_um", kMicrons * poses.best_fit_mm},
          {"first_view_um", kMicrons * poses.first_view_mm},
          {"by_view_um",
           over_views(evaluation::pose_errors_by_view_mm(truth.aligned, truth.T_model_sensor))}};
}

/// Errors of the thinned points, laid on the true jaw.
Result<Json> thinned_figures(const RegisteredTruth& truth, const TriangleMesh& jaw,
                             const Workers& workers, const Progress& progress) {
  const auto normals = normals::crossing_normals(truth.aligned, {}, workers, progress);
  if (!normals) return tl::unexpected(normals.error());
  const auto reduced = reduction::reduce_samples(
      normals::surface_samples(truth.aligned, *normals, workers), {}, workers, progress);
  if (!reduced) return tl::unexpected(reduced.error());
  TriangleMesh thinned;
  thinned.vertices = reduced->points;
  const Isometry T_model_world =
      truth.T_model_sensor.front() * truth.aligned.front().T_world_sensor.inverse();
  thinned = evaluation::transformed(thinned, T_model_world);
  const auto fit = evaluation::best_fit(thinned, jaw, {}, workers);
  if (!fit) return tl::unexpected(fit.error());
  thinned = evaluation::transformed(thinned, fit->T_truth_result);
  const auto error = evaluation::surface_error(thinned, jaw, {}, {}, workers);
  if (!error) return tl::unexpected(error.error());
  Json figures = {{"rms_um", kMicrons * error->distance.rms_mm},
                  {"median_um", kMicrons * error->distance.median_mm},
                  {"far_percent", 100.0 * error->far_share}};
  for (const reconstruct::JawSpan& span : reconstruct::jaw_spans(jaw, JawKind::kUpper)) {
    if (span.kind != reconstruct::JawSpanKind::kLastTeeth) continue;
    const auto longer_mm =
        length_error_mm(thinned, jaw, span.ends.from_mm, span.ends.to_mm, workers);
    // A short scan does not reach them.
    if (!longer_mm && longer_mm.error().code == ErrorCode::kInsufficient) continue;
    if (!longer_mm) return tl::unexpected(longer_mm.error());
    figures["last_molars_um"] = kMicrons * std::abs(*longer_mm);
  }
  return figures;
}

/// The figures of one scan with one kind of noise.
Result<Json> scan_figures(const TriangleMesh& jaw, const SimulatedScanOptions& options,
                          const Workers& workers, const Progress& progress) {
  const auto scan = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  auto truth = register_scan(*scan, progress);
  if (!truth) return tl::unexpected(truth.error());
  Json figures = {{"registered", truth->aligned.size()}, {"live", pose_figures(*truth)}};
  progress.begin_stage("Optimizing together");
  const auto refinement = refinement::refine_jointly(truth->aligned, {}, workers, progress);
  if (!refinement) return tl::unexpected(refinement.error());
  figures["final"] = pose_figures(*truth);
  // Without noise, thinning takes the small errors of the poses for outliers.
  if (options.noise.sigma_mm <= kIdealSigma_mm) return figures;
  progress.begin_stage("Thinning");
  auto thinned = thinned_figures(*truth, jaw, workers, progress);
  if (!thinned) return thinned;
  figures["thinned"] = *std::move(thinned);
  return figures;
}

/// Noise of single points, and its name in records.
struct NamedNoise {
  const char* name;
  simulated::ViewNoise noise;
};

/// What measured noise is like at the nearest, a middle and the farthest plane.
Json describe(const simulated::MeasuredNoise& noise) {
  const std::vector<double> depths_mm = noise.depths_mm(Pattern::kVertical);
  Json planes = Json::array();
  for (const double z_mm : {depths_mm.front(), depths_mm[depths_mm.size() / 2], depths_mm.back()}) {
    const NoiseFigures figures = noise_figures(noise, z_mm);
    planes.push_back({{"z_mm", z_mm},
                      {"sigma_um", kMicrons * figures.sigma_mm},
                      {"stated_um", kMicrons * figures.stated_mm},
                      {"correlation_samples", figures.correlation_samples},
                      {"kurtosis", figures.kurtosis},
                      {"beyond_3_sigma_percent", 100.0 * figures.beyond_3_sigma}});
  }
  return planes;
}

/// @param measured  null: without measured noise
Result<Json> measure(const Table2Arguments& arguments, const TriangleMesh& jaw,
                     const std::shared_ptr<const simulated::MeasuredNoise>& measured,
                     std::uint64_t seed, const Workers& workers, const Progress& progress) {
  std::vector<NamedNoise> noises = {{"ideal", {kIdealSigma_mm, 0.0, seed}},
                                    {"white", {kSigma_mm, 0.0, seed}},
                                    {"correlated", {kSigma_mm, kCorrelationSamples, seed}}};
  if (measured) noises.push_back({kMeasured, {.seed = seed, .measured = measured}});
  Json record = {{"views", arguments.view_count}};
  if (measured) record[kNoiseOfPlanes] = describe(*measured);
  for (const NamedNoise& named : noises) {
    SimulatedScanOptions options;
    options.view_count = arguments.view_count;
    options.path.seed = seed;
    options.noise = named.noise;
    auto figures = scan_figures(jaw, options, workers, progress);
    if (!figures) return figures;
    record[named.name] = *std::move(figures);
  }
  return record;
}

/// A row of the table: where its figure is in a record.
struct Table2Row {
  std::string_view name;
  const char* stage;
  const char* figure;
  double paper = 0.0;  ///< its figure in the paper; 0: there is none
};

constexpr std::array<Table2Row, 10> kRows = {
    {{"real-time, noise included, best fit", "live", "points_um", 300.0},
     {"real-time, poses alone, best fit", "live", "best_fit_um", 300.0},
     {"real-time, poses alone, first view", "live", "first_view_um"},
     {"final, noise included, best fit", "final", "points_um", 32.0},
     {"final, noise removed, best fit", "final", "best_fit_um", 24.0},
     {"final, noise removed, first view", "final", "first_view_um"},
     {"thinned points to the surface, RMS", "thinned", "rms_um"},
     {"the same, median", "thinned", "median_um"},
     {"thinned points off by over 0.1 mm, %", "thinned", "far_percent"},
     {"distance of the last molars", "thinned", "last_molars_um"}}};

/// Median and largest of a figure over the seeds, as "2.4 (2.9)"; "-" if no record has it.
std::string over_seeds(const Json& records, const char* noise, const Table2Row& row) {
  std::vector<double> values;
  for (const Json& record : records) {
    const Json& stages = record.at(noise);
    if (!stages.contains(row.stage) || !stages.at(row.stage).contains(row.figure)) continue;
    values.push_back(stages.at(row.stage).at(row.figure).get<double>());
  }
  if (values.empty()) return "-";
  const double largest = *std::max_element(values.begin(), values.end());
  std::sort(values.begin(), values.end());
  const int decimals = quantile_of(values, 0.5) < 1.0 ? 3 : 1;
  return fmt::format("{:.{}f} ({:.{}f})", quantile_of(values, 0.5), decimals, largest, decimals);
}

Result<std::shared_ptr<const simulated::MeasuredNoise>> measured_noise(
    const Table2Arguments& arguments, const Workers& workers, const Progress& progress) {
  if (arguments.noise_from.empty()) return nullptr;
  auto noise = read_plane_noise(arguments.noise_from, arguments.noise_exposures, workers, progress);
  if (!noise) return tl::unexpected(noise.error());
  return std::make_shared<const simulated::MeasuredNoise>(*std::move(noise));
}

Result<void> run(const Table2Arguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  const auto noise = measured_noise(arguments, workers, progress);
  if (!noise) return tl::unexpected(noise.error());
  SeededStudy table2 = {{{"views", arguments.view_count}}, [&](std::uint64_t seed) {
                          return measure(arguments, *jaw, *noise, seed, workers, progress);
                        }};
  if (*noise) {
    // Its name alone: parts may run on machines that keep the set in other places.
    table2.options["noise_from"] =
        std::filesystem::weakly_canonical(arguments.noise_from).filename().string();
    table2.options["noise_exposures"] = arguments.noise_exposures;
  }
  return run_seeds(table2, kTable2Printer, arguments.seeds);
}

void print_noise(const Json& planes) {
  fmt::print("\n{:<12} {:>9} {:>10} {:>22} {:>9} {:>15}\n", "noise at z", "sigma, µm", "stated, µm",
             "correlated, samples", "kurtosis", "beyond 3 sigma");
  for (const Json& plane : planes) {
    fmt::print("{:>9.1f} mm {:>9.1f} {:>10.1f} {:>22.2f} {:>9.2f} {:>13.2f} %\n",
               plane.at("z_mm").get<double>(), plane.at("sigma_um").get<double>(),
               plane.at("stated_um").get<double>(), plane.at("correlation_samples").get<double>(),
               plane.at("kurtosis").get<double>(),
               plane.at("beyond_3_sigma_percent").get<double>());
  }
}

}  // namespace

void print_table2(const Json& records) {
  fmt::print("\n{} scans of {} views; µm, median and largest over the scans\n", records.size(),
             records.front().at("views").get<int>());
  const bool has_measured = records.front().contains(kMeasured);
  std::vector<const char*> noises = {"white", "correlated"};
  if (has_measured) noises.push_back(kMeasured);
  noises.push_back("ideal");
  fmt::print("{:<38} {:>6}", "", "paper");
  for (const char* noise : noises) fmt::print(" {:>17}", noise);
  fmt::print("\n{:<38} {:>6}", "registered views, least", "");
  for (const char* noise : noises) {
    int least = std::numeric_limits<int>::max();
    for (const Json& record : records) {
      least = std::min(least, record.at(noise).at("registered").get<int>());
    }
    fmt::print(" {:>17}", least);
  }
  for (const Table2Row& row : kRows) {
    fmt::print("\n{:<38} {:>6}", row.name,
               row.paper > 0.0 ? fmt::format("{:.0f}", row.paper) : std::string());
    for (const char* noise : noises) fmt::print(" {:>17}", over_seeds(records, noise, row));
  }
  fmt::print("\n");
  if (has_measured) print_noise(records.front().at(kNoiseOfPlanes));
}

void add_table2_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<Table2Arguments>();
  CLI::App* command = study.add_subcommand(
      "table2",
      "Measure the errors of the registration on simulated views of a dental arch (Table 2)");
  add_seed_options(*command, arguments->seeds, "--seeds",
                   "Scans with each kind of noise, each on another path");
  command->add_option("--views", arguments->view_count, "Views of each scan")
      ->check(CLI::Range(20, 5000))
      ->capture_default_str();
  const auto noise_from = command->add_option(
      "--noise-from", arguments->noise_from,
      "Add noise as measured, too: that of the planes of this calibration set, a folder with "
      "calibration-set.json");
  command
      ->add_option(
          "--noise-exposures", arguments->noise_exposures,
          "Exposures averaged in each image of that set: the noise of one is larger by the "
          "square root, if theirs is independent")
      ->needs(noise_from)
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer(
      "Examples: flytri-lab table2 --seeds 10 -o table2.json\n"
      "          flytri-lab table2 --noise-from scans/calibration-set");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
