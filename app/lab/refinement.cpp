/// @file  flytri-lab refinement: compares the joint optimization with the random metaviews of the
/// paper, on the same registered views.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/cli/report.h"
#include "app/lab/simulated_scan.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/pose_error.h"
#include "core/refinement/refine.h"

namespace flytri::lab {
namespace {

struct RefinementArguments {
  int view_count = 300;
  int seed_count = 5;
  int thread_count = 0;
};

/// Sums over the scans.
struct Sum {
  double best_fit_squares = 0.0, first_view_squares = 0.0;  // mm^2
  double time_s = 0.0;

  void add(const RegisteredTruth& truth, double start_s) {
    time_s += cli::steady_seconds() - start_s;
    const evaluation::PoseError error = evaluation::pose_error(truth.aligned, truth.T_model_sensor);
    best_fit_squares += error.best_fit_mm * error.best_fit_mm;
    first_view_squares += error.first_view_mm * error.first_view_mm;
  }
};

/// All scans with one kind of noise.
struct Sums {
  Sum registered, by_metaviews, jointly;
  std::size_t view_count = 0;
};

std::string row(std::string_view name, const Sum& sum, int scans) {
  return fmt::format("  {:<32} {:>9.1f} {:>11.1f} {:>12.2f}", name,
                     kMicrons * std::sqrt(sum.best_fit_squares / scans),
                     kMicrons * std::sqrt(sum.first_view_squares / scans), sum.time_s / scans);
}

Result<void> compare(const RegisteredTruth& registered, const Workers& workers,
                     const Progress& progress, Sums& sums) {
  sums.view_count += registered.aligned.size();
  sums.registered.add(registered, cli::steady_seconds());
  RegisteredTruth by_metaviews = registered;
  double start_s = cli::steady_seconds();
  progress.begin_stage("Optimizing by metaviews");
  const auto reference = refinement::refine_by_metaviews(by_metaviews.aligned, {}, progress);
  if (!reference) return tl::unexpected(reference.error());
  sums.by_metaviews.add(by_metaviews, start_s);
  RegisteredTruth jointly = registered;
  start_s = cli::steady_seconds();
  progress.begin_stage("Optimizing together");
  const auto joint = refinement::refine_jointly(jointly.aligned, {}, workers, progress);
  if (!joint) return tl::unexpected(joint.error());
  sums.jointly.add(jointly, start_s);
  return {};
}

Result<Sums> compare_scans(const TriangleMesh& jaw, double correlation_samples,
                           const RefinementArguments& arguments, const Workers& workers,
                           const Progress& progress) {
  Sums sums;
  for (int seed = 1; seed <= arguments.seed_count; ++seed) {
    SimulatedScanOptions options;
    options.view_count = arguments.view_count;
    options.noise.correlation_samples = correlation_samples;
    options.noise.seed = static_cast<std::uint64_t>(seed);
    options.path.seed = static_cast<std::uint64_t>(seed);
    const auto scan = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
    if (!scan) return tl::unexpected(scan.error());
    const auto registered = register_scan(*scan, progress);
    if (!registered) return tl::unexpected(registered.error());
    if (auto done = compare(*registered, workers, progress, sums); !done) {
      return tl::unexpected(done.error());
    }
  }
  return sums;
}

Result<void> run(const RefinementArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  std::vector<std::string> rows;
  for (const double correlation_samples : {0.0, 1.5}) {
    const auto sums = compare_scans(*jaw, correlation_samples, arguments, workers, progress);
    if (!sums) return tl::unexpected(sums.error());
    const int scans = arguments.seed_count;
    rows.push_back(fmt::format("noise of 30 µm, correlated over {} samples; {} of {} views",
                               correlation_samples, sums->view_count,
                               scans * arguments.view_count));
    rows.push_back(row("as registered", sums->registered, scans));
    rows.push_back(row("random metaviews", sums->by_metaviews, scans));
    rows.push_back(row("jointly", sums->jointly, scans));
  }
  fmt::print("\n{:<34} {:>9} {:>11} {:>12}\n", "errors of the poses, µm, RMS", "best fit",
             "first view", "per scan, s");
  for (const std::string& line : rows) fmt::print("{}\n", line);
  return {};
}

}  // namespace

void add_refinement_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<RefinementArguments>();
  CLI::App* command = study.add_subcommand(
      "refinement", "Compare the joint optimization with that of the paper: errors and time");
  command->add_option("--views", arguments->view_count, "Views of each scan")
      ->check(CLI::Range(20, 5000))
      ->capture_default_str();
  command
      ->add_option("--seeds", arguments->seed_count,
                   "Scans of each kind, each with another random path")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab refinement --views 1000 --seeds 1");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
