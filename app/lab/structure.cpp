/// @file  flytri-lab structure: which scans of surfaces with little structure finish, and whether
/// any view gets a wrong pose.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/lab/right_views.h"
#include "app/lab/simulated_scan.h"
#include "app/lab/structure_scene.h"
#include "app/lab/studies.h"
#include "core/refinement/refine.h"
#include "core/tracking/registrar.h"

namespace flytri::lab {
namespace {

using Json = nlohmann::ordered_json;

struct StructureArguments {
  SeedArguments seeds;
  std::vector<std::string> scenes = {"ridge", "palate", "tooth", "flat"};
  int view_count = 200;
  int thread_count = 0;
};

/// A scan has finished if tracking was never interrupted and this share of its views has poses.
constexpr double kFinishedShare = 0.95;

/// The operator should be warned so long before tracking is lost.
constexpr double kWarnedAhead_s = 0.5;

/// What became of the scan of one scene.
struct StructureRecord {
  int registered = 0;           ///< in the end
  int wrong = 0;                ///< of these, as registered
  int wrong_refined = 0;        ///< and after the joint refinement
  bool is_interrupted = false;  ///< at any time
  int rejected = 0;             ///< when they came
  int warned = 0;               ///< views with a warning
  std::optional<double> first_warned_s;
  /// Of the first rejected view after the first second: there, nothing can be known before.
  std::optional<double> first_lost_s;
};

Result<StructureRecord> scan_scene(const SimulatedScan& scan, const Workers& workers,
                                   const Progress& progress) {
  auto registrar = tracking::Registrar::create();
  if (!registrar) return tl::unexpected(registrar.error());
  StructureRecord record;
  progress.begin_stage("Registering views", scan.views.size());
  for (const auto& view : scan.views) {
    if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped while registering");
    const tracking::RegisteredView registered = registrar->add(view);
    progress.advance();
    record.is_interrupted |= registrar->interrupted();
    if (registrar->surface_hold().is_weak) {
      ++record.warned;
      if (!record.first_warned_s) record.first_warned_s = view->time_s;
    }
    if (registered.fate != tracking::ViewFate::kRejected) continue;
    ++record.rejected;
    if (view->time_s > 1.0 && !record.first_lost_s) record.first_lost_s = view->time_s;
  }
  std::vector<AlignedView> placed;
  std::vector<Isometry> T_model_sensor;
  for (const tracking::RegisteredView& view : registrar->finish()) {
    if (view.fate == tracking::ViewFate::kRejected) continue;
    placed.push_back({view.view, view.T_world_sensor});
    T_model_sensor.push_back(scan.T_model_sensor[view.view->frame.at()]);
  }
  record.registered = static_cast<int>(placed.size());
  record.wrong = record.registered - count_right(placed, T_model_sensor);
  if (placed.empty()) return record;
  progress.begin_stage("Optimizing together");
  const auto refined = refinement::refine_jointly(placed, {}, workers, progress);
  if (!refined) return tl::unexpected(refined.error());
  record.wrong_refined = record.registered - count_right(placed, T_model_sensor);
  return record;
}

Result<Json> measure(const StructureArguments& arguments, std::uint64_t seed,
                     const Workers& workers, const Progress& progress) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  Json record;
  for (const std::string& name : arguments.scenes) {
    const auto scene =
        make_structure_scene(name, seed, arguments.view_count * sensor.frame_period_s, workers);
    if (!scene) return tl::unexpected(scene.error());
    SimulatedScanOptions options;
    options.view_count = arguments.view_count;
    options.noise.seed = seed;
    options.noise.correlation_samples = 1.5;
    const auto scan =
        simulate_scan_along(scene->mesh, sensor, scene->path, options, workers, progress);
    if (!scan) return tl::unexpected(scan.error());
    const auto counts = scan_scene(*scan, workers, progress);
    if (!counts) return tl::unexpected(counts.error());
    const bool has_finished =
        !counts->is_interrupted && counts->registered >= kFinishedShare * arguments.view_count;
    Json& figures = record[name] = {{"views", arguments.view_count},
                                    {"registered", counts->registered},
                                    {"rejected_live", counts->rejected},
                                    {"warned", counts->warned},
                                    {"interrupted", counts->is_interrupted},
                                    {"finished", has_finished},
                                    {"wrong", counts->wrong},
                                    {"wrong_refined", counts->wrong_refined}};
    if (counts->first_warned_s) figures["first_warned_s"] = *counts->first_warned_s;
    if (counts->first_lost_s) figures["first_lost_s"] = *counts->first_lost_s;
  }
  return record;
}

/// What the scans of one scene say together.
struct StructureSums {
  int scans = 0, finished = 0, interrupted = 0, views = 0, registered = 0, wrong = 0, refined = 0;
  int warned = 0, losses = 0, ahead = 0;

  void add(const Json& figures) {
    ++scans;
    finished += figures.at("finished").get<bool>() ? 1 : 0;
    interrupted += figures.at("interrupted").get<bool>() ? 1 : 0;
    views += figures.at("views").get<int>();
    registered += figures.at("registered").get<int>();
    wrong += figures.at("wrong").get<int>();
    refined += figures.at("wrong_refined").get<int>();
    warned += figures.at("warned").get<int>();
    if (!figures.contains("first_lost_s")) return;
    ++losses;
    const double lost_s = figures.at("first_lost_s").get<double>();
    ahead += figures.contains("first_warned_s") &&
                     figures.at("first_warned_s").get<double>() <= lost_s - kWarnedAhead_s
                 ? 1
                 : 0;
  }
};

}  // namespace

void print_structure(const Json& records) {
  fmt::print("\n{:<8} {:>6} {:>9} {:>11} {:>8} {:>10} {:>6} {:>14} {:>9} {:>26}\n", "scene",
             "scans", "finished", "interrupted", "views", "registered", "wrong", "wrong, refined",
             "warned, %", "losses, warned 0.5 s ahead");
  for (const std::string& name : structure_scene_names()) {
    StructureSums sums;
    for (const Json& record : records) {
      if (record.contains(name)) sums.add(record.at(name));
    }
    if (sums.scans == 0) continue;
    fmt::print("{:<8} {:>6} {:>9} {:>11} {:>8} {:>10} {:>6} {:>14} {:>9.0f} {:>26}\n", name,
               sums.scans, sums.finished, sums.interrupted, sums.views, sums.registered, sums.wrong,
               sums.refined, 100.0 * sums.warned / sums.views,
               fmt::format("{}, {}", sums.losses, sums.ahead));
  }
}

void add_structure_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<StructureArguments>();
  CLI::App* command = lab.add_subcommand(
      "structure",
      "Scan surfaces that hardly fix the pose of a view: ridges, palates, flat pieces");
  add_seed_options(*command, arguments->seeds, "--seeds", "Scans, each of another shape and hand");
  // The lists stand in the description: before it they are too wide for the manual page.
  command
      ->add_option("--scenes", arguments->scenes,
                   fmt::format("Surfaces to scan: {}", fmt::join(structure_scene_names(), ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(structure_scene_names()).description(""))
      ->default_str(fmt::format("{}", fmt::join(arguments->scenes, ",")));
  command->add_option("--views", arguments->view_count, "Views of each scan")
      ->check(CLI::Range(20, 5000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer(
      "Example: flytri-lab structure --scenes ridge,palate --seeds 10 -o structure.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) {
      const Workers workers(arguments->thread_count);
      const SeededStudy structure = {
          {{"scenes", arguments->scenes}, {"views", arguments->view_count}},
          [&](std::uint64_t seed) { return measure(*arguments, seed, workers, progress); }};
      return run_seeds(structure, kStructurePrinter, arguments->seeds);
    };
  });
}

}  // namespace flytri::lab
