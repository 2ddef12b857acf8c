/// @file  flytri study refinement: the joint optimization beside the paper's random metaviews, on
/// the same registered views.
#include <fmt/format.h>

#include <memory>

#include "app/cli/report.h"
#include "app/cli/simulated_scan.h"
#include "app/cli/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/pose_error.h"
#include "core/refinement/refine.h"

namespace flytri::cli {
namespace {

constexpr double kMicrons = 1e3;

struct RefinementArguments {
  int view_count = 1000;
  int thread_count = 0;
};

std::string row(std::string_view name, const RegisteredTruth& truth, double time_s) {
  const PoseError error = pose_error(truth.aligned, truth.T_model_sensor);
  return fmt::format("{:<34} {:>9.1f} {:>11.1f} {:>8.1f}", name, kMicrons * error.best_fit_mm,
                     kMicrons * error.first_view_mm, time_s);
}

Result<void> compare(const RegisteredTruth& registered, const Workers& workers,
                     const Progress& progress, std::vector<std::string>& rows) {
  rows.push_back(row("as registered", registered, 0.0));
  RegisteredTruth by_metaviews = registered;
  double start_s = steady_seconds();
  const auto reference = refine_by_metaviews(by_metaviews.aligned, {}, progress);
  if (!reference) return tl::unexpected(reference.error());
  rows.push_back(row(fmt::format("random metaviews, {} rounds", reference->moved_mm.size()),
                     by_metaviews, steady_seconds() - start_s));
  RegisteredTruth jointly = registered;
  start_s = steady_seconds();
  const auto joint = refine_jointly(jointly.aligned, {}, workers, progress);
  if (!joint) return tl::unexpected(joint.error());
  rows.push_back(
      row(fmt::format("jointly, {} steps", joint->steps), jointly, steady_seconds() - start_s));
  return {};
}

Result<void> run(const RefinementArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  std::vector<std::string> rows;
  for (const double correlation_samples : {0.0, 1.5}) {
    SimulatedScanOptions options;
    options.view_count = arguments.view_count;
    options.noise.correlation_samples = correlation_samples;
    const auto scan = simulate_scan(*jaw, intraoral_sensor(), options, workers, progress);
    if (!scan) return tl::unexpected(scan.error());
    const auto registered = register_scan(*scan, progress);
    if (!registered) return tl::unexpected(registered.error());
    rows.push_back(fmt::format("30 um, correlated over {} samples: {} views", correlation_samples,
                               registered->aligned.size()));
    if (auto done = compare(*registered, workers, progress, rows); !done) return done;
  }
  fmt::print("\n{:<34} {:>9} {:>11} {:>8}\n", "errors of the poses, um", "best fit", "first view",
             "time, s");
  for (const std::string& line : rows) fmt::print("{}\n", line);
  return {};
}

}  // namespace

void add_refinement_study(CLI::App& study, Invocation& invocation) {
  const auto arguments = std::make_shared<RefinementArguments>();
  CLI::App* command = study.add_subcommand(
      "refinement", "The joint optimization beside the paper's, in error and time");
  command->add_option("--views", arguments->view_count, "Views to simulate")
      ->check(CLI::Range(20, 5000))
      ->capture_default_str();
  add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri study refinement --views 500");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
