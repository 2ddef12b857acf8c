/// @file  flytri-lab growth: time of each stage and peak memory as scans get longer.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "app/lab/simulated_scan.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/files/file_bytes.h"

namespace flytri::lab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct GrowthArguments {
  fs::path output;
  bool force = false;
  std::vector<int> view_counts = {250, 500, 1000, 2000};
  int thread_count = 0;
};

/// One scan, reconstructed.
struct GrowthStep {
  int view_count = 0;
  std::vector<StageTime> stages;
  double peak_mib = 0.0;  ///< of the whole program during the reconstruction
};

/// Resets the peak to the memory in use now. If that is not permitted, the peak of the earlier
/// scans remains, which are smaller.
void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

double peak_memory_mib() {
  constexpr double kKibInMib = 1024.0;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / kKibInMib;
  }
  return 0.0;
}

Result<GrowthStep> run_step(const TriangleMesh& jaw, int view_count, const Workers& workers,
                            const Progress& progress) {
  SimulatedScanOptions scan_options;
  scan_options.view_count = view_count;
  auto scan = simulate_scan(jaw, simulated::intraoral_sensor(), scan_options, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  scan->ideal_views.clear();
  reset_peak_memory();
  reconstruct::ReconstructOptions options;
  options.now_s = cli::steady_seconds;
  const auto result =
      reconstruct::reconstruct_views(std::move(scan->views), options, workers, progress);
  if (!result) return tl::unexpected(result.error());
  return GrowthStep{view_count, result->stages, peak_memory_mib()};
}

/// The power p in "figure ~ views^p", from the first scan to the last.
double growth_power(double first, double last, const std::vector<GrowthStep>& steps) {
  return std::log(last / first) /
         std::log(double(steps.back().view_count) / double(steps.front().view_count));
}

void print_row(const std::string& name, const std::vector<double>& figures,
               const std::vector<GrowthStep>& steps) {
  fmt::print("{:<24}", name);
  for (const double figure : figures) fmt::print(" {:>9.1f}", figure);
  fmt::print(" {:>8.2f}\n", growth_power(figures.front(), figures.back(), steps));
}

void print_table(const std::vector<GrowthStep>& steps) {
  fmt::print("\n{:<24}", "views");
  for (const GrowthStep& step : steps) fmt::print(" {:>9}", step.view_count);
  fmt::print(" {:>8}\n", "power");
  for (std::size_t stage = 0; stage < steps.front().stages.size(); ++stage) {
    std::vector<double> seconds;
    seconds.reserve(steps.size());
    for (const GrowthStep& step : steps) seconds.push_back(step.stages[stage].seconds);
    print_row(steps.front().stages[stage].name + ", s", seconds, steps);
  }
  std::vector<double> memory;
  memory.reserve(steps.size());
  for (const GrowthStep& step : steps) memory.push_back(step.peak_mib);
  print_row("peak memory, MiB", memory, steps);
  fmt::print("power: a figure grows with this power of the number of views; 1 is linear.\n");
}

Json to_json(const GrowthStep& step) {
  Json stages = Json::array();
  for (const StageTime& stage : step.stages) {
    stages.push_back({{"name", stage.name},
                      {"seconds", stage.seconds},
                      {"items", stage.item_count},
                      {"item", stage.item_name}});
  }
  return {{"views", step.view_count}, {"peak_mib", step.peak_mib}, {"stages", stages}};
}

Result<void> run(const GrowthArguments& arguments, const Progress& progress) {
  auto checked = cli::check_output_files({}, {{arguments.output, kStudyFormat}}, arguments.force);
  if (!checked) return checked;
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  std::vector<GrowthStep> steps;
  Json scans = Json::array();
  for (const int view_count : arguments.view_counts) {
    auto step = run_step(*jaw, view_count, workers, progress);
    if (!step) return tl::unexpected(step.error());
    scans.push_back(to_json(*step));
    steps.push_back(std::move(*step));
  }
  print_table(steps);
  if (arguments.output.empty()) return {};
  const Json document = {
      {"format", kStudyFormat}, {"version", 1}, {"study", "growth"}, {"scans", scans}};
  return io::write_file(arguments.output, document.dump(1) + "\n");
}

}  // namespace

void add_growth_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<GrowthArguments>();
  CLI::App* command = study.add_subcommand(
      "growth", "Measure time and peak memory of simulated scans of increasing length");
  command->add_option("-o,--output", arguments->output, "JSON file for the figures");
  cli::add_force_option(*command, arguments->force);
  command
      ->add_option("--views", arguments->view_counts,
                   "Numbers of views: at least two, in rising order")
      ->check(CLI::Range(20, 5000))
      ->expected(2, 20)
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab growth --views 250 500 1000 2000");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
