/// @file  flytri-lab occlusion: how well bite scans bring simulated jaws together.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/lab/closed_jaws.h"
#include "app/lab/reconstructed_scan.h"
#include "app/lab/studies.h"
#include "core/base/median.h"
#include "core/occlusion/clearance.h"
#include "core/occlusion/occlude.h"

namespace flytri::lab {
namespace {

using Json = nlohmann::ordered_json;

struct OcclusionArguments {
  SeedArguments seeds{{}, false, 1, 20, {}};
  int view_count = 500;
  int bite_view_count = 90;
  int thread_count = 0;
};

/// An error of the relation beside what was predicted, at one place.
struct PlaceError {
  double error_mm = 0.0, predicted_mm = 0.0;
};

struct OcclusionError {
  PlaceError middle;
  std::array<PlaceError, 2>
      ends;  ///< last molars: of the scanned side of one bite, of the other side
  double angle_deg = 0.0, predicted_angle_deg = 0.0;
  double contact_median_mm = 0.0;  ///< of the error of clearances below 0.5 mm
};

/// Median error of the distances between the jaws where they are near.
double contact_error_mm(const ClosedJaws& jaws, const Isometry& T_upper_lower,
                        const Workers& workers) {
  constexpr double kNear_mm = 0.5;
  const occlusion::JawSurface upper(jaws.upper);
  const auto truth = find_clearance(jaws.lower, upper, jaws.T_upper_lower, kNear_mm, workers);
  const auto found = find_clearance(jaws.lower, upper, T_upper_lower, 2.0 * kNear_mm, workers);
  std::vector<double> errors_mm;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error_mm = std::abs(truth[i] - found[i]);
    if (!std::isnan(error_mm)) errors_mm.push_back(error_mm);
  }
  return errors_mm.empty() ? 0.0 : median_of(errors_mm);
}

OcclusionError error_of(const occlusion::Occlusion& found, const ClosedJaws& jaws,
                        const ReconstructedScan& upper, const ReconstructedScan& lower,
                        const Workers& workers) {
  // Both in the frame of the true upper jaw.
  const Isometry T_found =
      upper.T_model_world * found.T_upper_lower * lower.T_model_world.inverse();
  const Isometry T_error = T_found * jaws.T_upper_lower.inverse();
  const auto at = [&](const Vec3& p_mm) {
    return PlaceError{(T_error * p_mm - p_mm).norm(),
                      found.uncertainty_mm(upper.T_model_world.inverse() * p_mm)};
  };
  OcclusionError error;
  error.middle = at(upper.T_model_world * found.middle_mm);
  error.ends = {at(jaws.ends_mm[0]), at(jaws.ends_mm[1])};
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  error.angle_deg = kDegrees * rotation_angle(T_error);
  error.predicted_angle_deg = kDegrees * std::sqrt(found.covariance.topLeftCorner<3, 3>().trace());
  error.contact_median_mm = contact_error_mm(jaws, T_found, workers);
  return error;
}

Json json_of(const OcclusionError& error, std::size_t sides) {
  const auto place = [](const PlaceError& at) {
    return Json{{"error_um", kMicrons * at.error_mm}, {"predicted_um", kMicrons * at.predicted_mm}};
  };
  return {{"sides", sides},
          {"middle", place(error.middle)},
          {"last_molar_scanned_side", place(error.ends[0])},
          {"last_molar_other_side", place(error.ends[1])},
          {"angle_deg", error.angle_deg},
          {"predicted_angle_deg", error.predicted_angle_deg},
          {"contact_median_um", kMicrons * error.contact_median_mm}};
}

/// One pair of jaws, with one and with two bite scans.
Result<Json> measure(const OcclusionArguments& arguments, std::uint64_t seed,
                     const Workers& workers, const Progress& progress) {
  const auto jaws = close_sample_jaws(seed, workers);
  if (!jaws) return tl::unexpected(jaws.error());
  const auto upper = scan_arch(jaws->upper, JawKind::kUpper, arguments.view_count, 10 * seed + 1,
                               workers, progress);
  if (!upper) return tl::unexpected(upper.error());
  const auto lower = scan_arch(jaws->lower, JawKind::kLower, arguments.view_count, 10 * seed + 2,
                               workers, progress);
  if (!lower) return tl::unexpected(lower.error());
  std::vector<ReconstructedScan> bites;
  for (const bool is_right : {false, true}) {
    auto scan = scan_bite(*jaws, is_right, arguments.bite_view_count,
                          10 * seed + (is_right ? 4 : 3), workers, progress);
    if (!scan) return tl::unexpected(scan.error());
    auto bite = reconstruct_scan(*scan, jaws->closed, std::nullopt, workers, progress);
    if (!bite) return tl::unexpected(bite.error());
    bites.push_back(*std::move(bite));
  }
  Json rows = Json::array();
  std::vector<occlusion::BiteScan> scans;
  for (const ReconstructedScan& bite : bites) {
    scans.push_back({fmt::format("bite {}", scans.size() + 1), bite.surface.vertices});
    const auto found =
        occlusion::find_occlusion(upper->surface, lower->surface, scans, {}, workers, progress);
    if (!found) {
      rows.push_back({{"sides", scans.size()}, {"refused", found.error().message}});
      continue;
    }
    const OcclusionError error = error_of(*found, *jaws, *upper, *lower, workers);
    rows.push_back(json_of(error, scans.size()));
  }
  return Json{{"bites", std::move(rows)}};
}

}  // namespace

void print_occlusion(const Json& records) {
  const auto number = [](const Json& bite, const char* key) { return bite.at(key).get<double>(); };
  const auto place = [&](const Json& bite, const char* key) {
    return fmt::format("{:6.1f} {:6.1f}", number(bite.at(key), "error_um"),
                       number(bite.at(key), "predicted_um"));
  };
  fmt::print(
      "Each: error, and its predicted standard uncertainty. µm; angle in degrees. Contact: median "
      "error\n");
  fmt::print("{:>4} {:>5}   {:^13}   {:^13}   {:^13}   {:^13}   {:>6}\n", "seed", "sides", "middle",
             "last molar", "far molar", "angle", "contact");
  for (const Json& record : records) {
    for (const Json& bite : record.at("bites")) {
      fmt::print("{:4} {:5}   ", record.at("seed").get<int>(), bite.at("sides").get<int>());
      if (bite.contains("refused")) {
        fmt::print("{}\n", bite.at("refused").get<std::string>());
        continue;
      }
      fmt::print("{}   {}   {}   {:6.4f} {:6.4f}   {:6.1f}\n", place(bite, "middle"),
                 place(bite, "last_molar_scanned_side"), place(bite, "last_molar_other_side"),
                 number(bite, "angle_deg"), number(bite, "predicted_angle_deg"),
                 number(bite, "contact_median_um"));
    }
  }
}

void add_occlusion_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<OcclusionArguments>();
  CLI::App* command =
      lab.add_subcommand("occlusion", "Measure how well bite scans bring simulated jaws together");
  add_seed_options(*command, arguments->seeds, "--jaws", "Pairs of jaws");
  command->add_option("--views", arguments->view_count, "Views of each jaw")
      ->check(CLI::Range(100, 5000))
      ->capture_default_str();
  command->add_option("--bite-views", arguments->bite_view_count, "Views of each bite scan")
      ->check(CLI::Range(20, 1000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab occlusion --jaws 20 -o occlusion.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) {
      const Workers workers(arguments->thread_count);
      const SeededStudy occlusion = {
          {{"views", arguments->view_count}, {"bite_views", arguments->bite_view_count}},
          [&](std::uint64_t seed) { return measure(*arguments, seed, workers, progress); }};
      return run_seeds(occlusion, kOcclusionPrinter, arguments->seeds);
    };
  });
}

}  // namespace flytri::lab
