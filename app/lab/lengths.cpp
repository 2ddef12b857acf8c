/// @file  flytri-lab lengths: are the predicted uncertainties of distances across a jaw honest?
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/lab/length_error.h"
#include "app/lab/reconstructed_scan.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/surface_error.h"
#include "core/reconstruct/jaw_spans.h"

namespace flytri::lab {
namespace {

using Json = nlohmann::ordered_json;

struct LengthsArguments {
  SeedArguments seeds{{}, false, 1, 50, {}};
  int view_count = 500;
  int thread_count = 0;
};

Result<Json> measure(const LengthsArguments& arguments, std::uint64_t seed, const Workers& workers,
                     const Progress& progress) {
  sample_jaw::SampleJawOptions jaw_options;
  jaw_options.seed = seed;
  jaw_options.kind = seed % 2 == 0 ? JawKind::kLower : JawKind::kUpper;
  const auto jaw = sample_jaw::make_sample_jaw(jaw_options, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  const auto scan =
      scan_arch(*jaw, jaw_options.kind, arguments.view_count, seed, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  const TriangleMesh scanned = evaluation::transformed(scan->surface, scan->T_model_world);
  Json distances = Json::array();
  for (const reconstruct::JudgedSpan& judged : scan->spans) {
    const refinement::Span& ends = judged.span.ends;
    const Vec3 from_mm = scan->T_model_world * ends.from_mm;
    const Vec3 to_mm = scan->T_model_world * ends.to_mm;
    const auto error_mm = length_error_mm(scanned, *jaw, from_mm, to_mm, workers);
    if (!error_mm) return tl::unexpected(error_mm.error());
    distances.push_back({{"distance", name_of(judged.span)},
                         {"length_mm", ends.length_mm()},
                         {"error_um", kMicrons * *error_mm},
                         {"predicted_um", kMicrons * judged.sigma_mm}});
  }
  return Json{{"distances", std::move(distances)}};
}

/// Of all scans, for one kind of span.
struct LengthSums {
  int count = 0, covered = 0;
  double errors2_um2 = 0.0, predicted2_um2 = 0.0;

  void add(double error_um, double predicted_um) {
    constexpr double kSigmasOf95 = 1.96;
    ++count;
    covered += std::abs(error_um) <= kSigmasOf95 * predicted_um ? 1 : 0;
    errors2_um2 += error_um * error_um;
    predicted2_um2 += predicted_um * predicted_um;
  }
};

}  // namespace

void print_lengths(const Json& records) {
  std::map<std::string, LengthSums> sums;
  fmt::print("\n{:>4}  {:<28} {:>10} {:>10} {:>13}\n", "seed", "distance", "length, mm",
             "error, µm", "predicted, µm");
  for (const Json& record : records) {
    for (const Json& distance : record.at("distances")) {
      const std::string name = distance.at("distance");
      const double error_um = distance.at("error_um"), predicted_um = distance.at("predicted_um");
      sums[name].add(error_um, predicted_um);
      fmt::print("{:4}  {:<28} {:10.2f} {:10.1f} {:13.1f}\n", record.at("seed").get<int>(), name,
                 distance.at("length_mm").get<double>(), error_um, predicted_um);
    }
  }
  fmt::print("\n{:<28} {:>5} {:>10} {:>13} {:>14}\n", "standard deviation, µm", "scans",
             "of errors", "as predicted", "within 95 %");
  for (const auto& [name, sum] : sums) {
    fmt::print("{:<28} {:5} {:10.1f} {:13.1f} {:9} ({:.0f} %)\n", name, sum.count,
               std::sqrt(sum.errors2_um2 / sum.count), std::sqrt(sum.predicted2_um2 / sum.count),
               sum.covered, 100.0 * sum.covered / sum.count);
  }
}

void add_lengths_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<LengthsArguments>();
  CLI::App* command = lab.add_subcommand(
      "lengths", "Compare errors of distances across simulated jaws with their predictions");
  add_seed_options(*command, arguments->seeds, "--scans", "Scans, each of another jaw");
  command->add_option("--views", arguments->view_count, "Views of each scan")
      ->check(CLI::Range(100, 5000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab lengths --scans 50 -o lengths.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) {
      const Workers workers(arguments->thread_count);
      const SeededStudy lengths = {{{"views", arguments->view_count}}, [&](std::uint64_t seed) {
                                     return measure(*arguments, seed, workers, progress);
                                   }};
      return run_seeds(lengths, kLengthsPrinter, arguments->seeds);
    };
  });
}

}  // namespace flytri::lab
