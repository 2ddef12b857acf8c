/// @file  flytri-lab lengths: are the predicted uncertainties of distances across a jaw honest?
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/output_files.h"
#include "app/lab/reconstructed_scan.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/best_fit.h"
#include "core/evaluation/surface_error.h"
#include "core/io/files/file_bytes.h"
#include "core/reconstruct/jaw_spans.h"

namespace flytri::lab {
namespace {

using Json = nlohmann::ordered_json;

struct LengthsArguments {
  std::filesystem::path output;
  bool force = false;
  int scan_count = 50;
  int view_count = 500;
  int thread_count = 0;
};

/// A span of one scan.
struct LengthError {
  reconstruct::JudgedSpan judged;
  double error_mm = 0.0;
  [[nodiscard]] bool is_covered() const { return std::abs(error_mm) <= judged.range95_mm(); }
};

/// How the surface around a place must move to lie on the true one.
Result<Vec3> displacement_at(const TriangleMesh& scanned, const Vec3& p_mm,
                             const TriangleMesh& truth, const Workers& workers) {
  constexpr double kPatch_mm = 5.0;
  TriangleMesh patch;
  for (const SurfacePoint& vertex : scanned.vertices) {
    if ((vertex.position_mm.cast<double>() - p_mm).norm() < kPatch_mm) {
      patch.vertices.push_back(vertex);
    }
  }
  const auto fit = evaluation::best_fit(patch, truth, {}, workers);
  if (!fit) return tl::unexpected(fit.error());
  return Vec3(fit->T_truth_result * p_mm - p_mm);
}

Result<std::vector<LengthError>> try_scan(const LengthsArguments& arguments, std::uint64_t seed,
                                          const Workers& workers, const Progress& progress) {
  sample_jaw::SampleJawOptions jaw_options;
  jaw_options.seed = seed;
  jaw_options.kind = seed % 2 == 0 ? JawKind::kLower : JawKind::kUpper;
  const auto jaw = sample_jaw::make_sample_jaw(jaw_options, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  const auto scan =
      scan_arch(*jaw, jaw_options.kind, arguments.view_count, seed, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  const TriangleMesh scanned = evaluation::transformed(scan->surface, scan->T_model_world);
  std::vector<LengthError> errors;
  for (const reconstruct::JudgedSpan& judged : scan->spans) {
    const refinement::Span& ends = judged.span.ends;
    const Vec3 from_mm = scan->T_model_world * ends.from_mm;
    const Vec3 to_mm = scan->T_model_world * ends.to_mm;
    const auto at_from = displacement_at(scanned, from_mm, *jaw, workers);
    const auto at_to = displacement_at(scanned, to_mm, *jaw, workers);
    if (!at_from) return tl::unexpected(at_from.error());
    if (!at_to) return tl::unexpected(at_to.error());
    const double error_mm = (*at_from - *at_to).dot((to_mm - from_mm).normalized());
    errors.push_back({judged, error_mm});
  }
  return errors;
}

/// Of all scans, for one kind of span.
struct LengthSums {
  int count = 0, covered = 0;
  double errors2_mm2 = 0.0, predicted2_mm2 = 0.0;
};

void print_sums(const std::map<std::string, LengthSums>& sums) {
  fmt::print("\n{:<28} {:>5} {:>10} {:>13} {:>14}\n", "standard deviation, µm", "scans",
             "of errors", "as predicted", "within 95 %");
  for (const auto& [name, sum] : sums) {
    fmt::print("{:<28} {:5} {:10.1f} {:13.1f} {:9} ({:.0f} %)\n", name, sum.count,
               kMicrons * std::sqrt(sum.errors2_mm2 / sum.count),
               kMicrons * std::sqrt(sum.predicted2_mm2 / sum.count), sum.covered,
               100.0 * sum.covered / sum.count);
  }
}

Result<void> run(const LengthsArguments& arguments, const Progress& progress) {
  auto checked = cli::check_output_files({}, {{arguments.output, "flytri.study"}}, arguments.force);
  if (!checked) return checked;
  const Workers workers(arguments.thread_count);
  std::map<std::string, LengthSums> sums;
  Json rows = Json::array();
  fmt::print("{:>4}  {:<28} {:>10} {:>10} {:>13}\n", "seed", "distance", "length, mm", "error, µm",
             "predicted, µm");
  for (int seed = 1; seed <= arguments.scan_count; ++seed) {
    const auto errors = try_scan(arguments, static_cast<std::uint64_t>(seed), workers, progress);
    if (!errors) return tl::unexpected(errors.error());
    for (const LengthError& error : *errors) {
      const std::string name = name_of(error.judged.span);
      const double length_mm = error.judged.span.ends.length_mm();
      const double predicted_mm = error.judged.sigma_mm;
      LengthSums& sum = sums[name];
      ++sum.count;
      sum.covered += error.is_covered() ? 1 : 0;
      sum.errors2_mm2 += error.error_mm * error.error_mm;
      sum.predicted2_mm2 += predicted_mm * predicted_mm;
      fmt::print("{:4}  {:<28} {:10.2f} {:10.1f} {:13.1f}\n", seed, name, length_mm,
                 kMicrons * error.error_mm, kMicrons * predicted_mm);
      std::fflush(stdout);
      rows.push_back({{"seed", seed},
                      {"distance", name},
                      {"length_mm", length_mm},
                      {"error_um", kMicrons * error.error_mm},
                      {"predicted_um", kMicrons * predicted_mm}});
    }
  }
  print_sums(sums);
  if (arguments.output.empty()) return {};
  const Json json = {
      {"format", "flytri.study"}, {"version", 1}, {"study", "lengths"}, {"lengths", rows}};
  return io::write_file(arguments.output, json.dump(1) + "\n");
}

}  // namespace

void add_lengths_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<LengthsArguments>();
  CLI::App* command = lab.add_subcommand(
      "lengths", "Compare errors of distances across simulated jaws with their predictions");
  command->add_option("-o,--output", arguments->output, "Also write the figures as .json");
  cli::add_force_option(*command, arguments->force);
  command->add_option("--scans", arguments->scan_count, "Scans, each of another jaw")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--views", arguments->view_count, "Views of each scan")
      ->check(CLI::Range(100, 5000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab lengths --scans 50 -o lengths.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
