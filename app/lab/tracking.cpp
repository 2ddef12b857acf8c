/// @file  flytri-lab tracking: how fast a scan may be, which interruptions it survives, and whether
/// any view gets a wrong pose.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/lab/right_views.h"
#include "app/lab/simulated_scan.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/tracking/registrar.h"

namespace flytri::lab {
namespace {

/// Views of the arch at the speed of the paper.
constexpr int kViewsAtPace = 1000;
struct TrackingArguments {
  int seed_count = 2;
  int thread_count = 0;
};

/// How a scan is disturbed.
struct Scenario {
  std::string name;
  double pace = 1.0;  ///< speed of the hand, relative to the paper
  simulated::ViewNoise noise;
  int gap_every = 0;  ///< views from one interruption to the next; 0: none
  int gap_views = 0;  ///< views without a surface in each
};

struct Counts {
  int views = 0, right = 0, rejected = 0, wrong = 0;
  double pace_mm_s = 0.0;
};

bool sees_nothing(const Scenario& scenario, std::size_t i) {
  if (scenario.gap_every == 0) return false;
  return static_cast<int>(i) % scenario.gap_every >= scenario.gap_every - scenario.gap_views;
}

double mean_pace_mm_s(const SimulatedScan& scan) {
  double length_mm = 0.0;
  for (std::size_t i = 1; i < scan.T_model_sensor.size(); ++i) {
    length_mm +=
        (scan.T_model_sensor[i].translation() - scan.T_model_sensor[i - 1].translation()).norm();
  }
  return length_mm / (scan.views.back()->time_s - scan.views.front()->time_s);
}

Result<Counts> track(const TriangleMesh& jaw, const Scenario& scenario, int seed,
                     const Workers& workers, const Progress& progress) {
  SimulatedScanOptions options;
  options.view_count = static_cast<int>(std::lround(kViewsAtPace / scenario.pace));
  options.noise = scenario.noise;
  options.noise.seed = static_cast<std::uint64_t>(seed);
  options.path.seed = static_cast<std::uint64_t>(seed);
  const auto scan = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  auto registrar = tracking::Registrar::create();
  if (!registrar) return tl::unexpected(registrar.error());
  Counts counts;
  counts.pace_mm_s = mean_pace_mm_s(*scan);
  progress.begin_stage("Registering views", scan->views.size());
  for (std::size_t i = 0; i < scan->views.size(); ++i) {
    if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped while registering");
    progress.advance();
    if (sees_nothing(scenario, i)) continue;
    registrar->add(scan->views[i]);
    ++counts.views;
  }
  std::vector<AlignedView> placed;
  std::vector<Isometry> T_model_sensor;
  for (const tracking::RegisteredView& view : registrar->finish()) {
    if (view.fate == tracking::ViewFate::kRejected) {
      ++counts.rejected;
    } else {
      placed.push_back({view.view, view.T_world_sensor});
      T_model_sensor.push_back(scan->T_model_sensor[view.view->frame.at()]);
    }
  }
  counts.right = count_right(placed, T_model_sensor);
  counts.wrong = static_cast<int>(placed.size()) - counts.right;
  return counts;
}

std::vector<Scenario> scenarios() {
  const simulated::ViewNoise white{0.03};
  simulated::ViewNoise correlated{0.03};
  correlated.correlation_samples = 1.5;
  simulated::ViewNoise none{1e-6};
  std::vector<Scenario> list;
  for (const double pace : {1.0, 2.0, 3.0, 4.0, 6.0, 10.0}) {
    list.push_back({fmt::format("{:g} x the speed, white noise", pace), pace, white});
    list.push_back({fmt::format("{:g} x the speed, correlated noise", pace), pace, correlated});
  }
  list.push_back({"ideal data, 2.5 x the speed", 2.5, none});
  list.push_back({"every 5 s, 0.3 s without a surface", 1.0, correlated, 150, 10});
  list.push_back({"every 5 s, 2 s without a surface", 1.0, correlated, 150, 60});
  return list;
}

Result<void> run(const TrackingArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  std::vector<std::string> rows;
  for (const Scenario& scenario : scenarios()) {
    Counts sum;
    for (int seed = 1; seed <= arguments.seed_count; ++seed) {
      const auto counts = track(*jaw, scenario, seed, workers, progress);
      if (!counts) return tl::unexpected(counts.error());
      sum.views += counts->views;
      sum.right += counts->right;
      sum.rejected += counts->rejected;
      sum.wrong += counts->wrong;
      sum.pace_mm_s += counts->pace_mm_s / arguments.seed_count;
    }
    rows.push_back(fmt::format("{:<38} {:>6.0f} {:>6} {:>6} {:>9} {:>6}", scenario.name,
                               sum.pace_mm_s, sum.views, sum.right, sum.rejected, sum.wrong));
  }
  fmt::print("\n{:<38} {:>6} {:>6} {:>6} {:>9} {:>6}\n", "scan of the arch", "mm/s", "views",
             "right", "rejected", "wrong");
  for (const std::string& row : rows) fmt::print("{}\n", row);
  return {};
}

}  // namespace

void add_tracking_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<TrackingArguments>();
  CLI::App* command = study.add_subcommand(
      "tracking", "Count right, rejected and wrong poses for fast and interrupted scans");
  command
      ->add_option("--seeds", arguments->seed_count,
                   "Scans of each kind, each with another random path")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab tracking --seeds 2");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
