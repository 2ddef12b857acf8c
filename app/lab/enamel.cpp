/// @file  flytri-lab enamel: what bare and wet teeth do to the lines, and whether a line shows it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "app/cli/drawing_files.h"
#include "app/cli/output_files.h"
#include "app/lab/enamel_picture.h"
#include "app/lab/enamel_samples.h"
#include "app/lab/studies.h"
#include "core/base/median.h"
#include "core/base/random.h"
#include "core/io/files/file_bytes.h"
#include "hw/simulated/datasets/sensor_calibration.h"

namespace flytri::lab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using simulated::ToothSurface;

struct EnamelArguments {
  fs::path output, picture;
  bool force = false;
  int image_count = 4;
  std::uint64_t seed = 1;
  double dry_share = 0.4;
  int thread_count = 0;
};

/// Depths near, in the middle and far; a plane that is tilted by 60 degrees stays in the volume.
constexpr std::array kDepths_mm = {-4.5, 0.0, 4.5};
constexpr std::array kTilts_degrees = {-60.0, -30.0, 0.0, 30.0, 60.0};
/// Of the highlight from the middle of a line: within the line, at its sides, and outside it.
constexpr std::array kOffsets_mm = {-0.15, -0.1, -0.05, 0.0, 0.05, 0.1, 0.15};
/// A point farther from the surface is off: 2.5 times the scatter of a sprayed one, or more.
constexpr double kOff_um = 50.0;

struct NamedSurface {
  std::string name;
  ToothSurface surface;
};

/// Sprayed, bare enamel, two more that are bare, wet.
std::vector<NamedSurface> surfaces_of(double dry_share) {
  // Water fills the roughness of the surface, so that less light is reflected without entering.
  constexpr double kWetShare = 0.5;
  return {{"sprayed", {}},
          {"bare enamel", {dry_share, simulated::enamel(), {}}},
          {"bare, clear enamel", {dry_share, simulated::clear_enamel(), {}}},
          {"bare dentin", {dry_share, simulated::dentin(), {}}},
          {"wet enamel", {kWetShare * dry_share, simulated::enamel(), simulated::GlossyFilm{}}}};
}

using Samples = std::vector<EnamelSample>;

/// One scene, measured with each surface.
struct EnamelTrial {
  EnamelScene scene;
  std::vector<Samples> samples;  ///< by surface
};

std::vector<EnamelTrial> make_trials(const simulated::SensorModel& sensor) {
  std::vector<EnamelTrial> trials;
  for (const double z_mm : kDepths_mm) {
    for (const double tilt : kTilts_degrees)
      trials.push_back({tilted_plane(sensor, z_mm, tilt), {}});
    for (const double offset : kOffsets_mm)
      trials.push_back({glossy_cusp(sensor, z_mm, offset), {}});
  }
  return trials;
}

Result<void> measure_trial(EnamelTrial& trial, const std::vector<NamedSurface>& surfaces,
                           const EnamelImages& images) {
  const simulated::ToothLight light(trial.scene.mesh, trial.scene.plane, images.sensor,
                                    kEnamelPattern);
  for (const NamedSurface& surface : surfaces) {
    auto samples = measure_enamel(trial.scene, light, surface.surface, images);
    if (!samples) return tl::unexpected(samples.error());
    trial.samples.push_back(*std::move(samples));
  }
  trial.scene.mesh = {};  // no longer needed, and large
  return {};
}

Result<std::vector<EnamelTrial>> measure_trials(const std::vector<NamedSurface>& surfaces,
                                                const EnamelImages& images, const Workers& workers,
                                                const Progress& progress) {
  std::vector<EnamelTrial> trials = make_trials(images.sensor);
  std::vector<Result<void>> results(trials.size());
  progress.begin_stage("Measuring teeth", static_cast<std::int64_t>(trials.size()));
  workers.for_each(trials.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    EnamelImages own = images;
    own.seed = Random(images.seed, i).next();
    results[i] = measure_trial(trials[i], surfaces, own);
    progress.advance();
  });
  if (progress.cancelled()) return stopped();
  for (const auto& result : results)
    if (!result) return tl::unexpected(result.error());
  return trials;
}

/// Needs at least one sample.
template <typename Value>
double median_by(const Samples& samples, const Value& value) {
  std::vector<double> values;
  for (const EnamelSample& sample : samples) values.push_back(value(sample));
  return median_of(values);
}

double property(const EnamelSample& sample, ShapeProperty which) {
  return sample.shape[static_cast<std::size_t>(which)];
}

/// Figures of one surface beside those of the sprayed one. Without samples only the share lost.
Json figures_of(const Samples& samples, const Samples& sprayed) {
  const auto count = static_cast<double>(samples.size());
  Json figures = {{"samples", samples.size()},
                  {"lost", 1.0 - count / std::max(static_cast<double>(sprayed.size()), 1.0)}};
  if (samples.empty()) return figures;
  const double bias_mm = median_by(samples, [](const EnamelSample& s) { return s.below_mm; });
  const double spread_mm =
      median_by(samples, [&](const EnamelSample& s) { return std::abs(s.below_mm - bias_mm); });
  const auto relative = [&](ShapeProperty which) {
    const auto of = [&](const EnamelSample& s) { return property(s, which); };
    return median_by(samples, of) / median_by(sprayed, of);
  };
  std::size_t off = 0, saturated = 0, saturated_off = 0;
  std::vector<double> errors_um;
  for (const EnamelSample& sample : samples) {
    errors_um.push_back(kMicrons * std::abs(sample.below_mm));
    const bool is_off = errors_um.back() > kOff_um;
    off += is_off ? 1 : 0;
    saturated += sample.is_saturated ? 1 : 0;
    saturated_off += is_off && sample.is_saturated ? 1 : 0;
  }
  std::sort(errors_um.begin(), errors_um.end());
  figures["below_um"] = kMicrons * bias_mm;
  figures["scatter_um"] = kMicrons * kSigmaOfMedian * spread_mm;
  figures["error_95_um"] = quantile_of(errors_um, 0.95);
  if (!sprayed.empty()) {
    figures["width"] = relative(ShapeProperty::kWidth);
    figures["height"] = relative(ShapeProperty::kHeight);
  }
  figures["off"] = off;
  figures["saturated"] = saturated;
  figures["saturated_off"] = saturated_off;
  return figures;
}

/// Means of a property over so many neighbors on a line.
std::vector<double> means_of(const Samples& samples, ShapeProperty which, std::size_t neighbors) {
  std::vector<double> means;
  for (std::size_t i = 0; i + neighbors <= samples.size();) {
    if (samples[i].run != samples[i + neighbors - 1].run) {
      ++i;
      continue;
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < neighbors; ++k) sum += property(samples[i + k], which);
    means.push_back(sum / static_cast<double>(neighbors));
    i += neighbors;
  }
  return means;
}

/// 0.36 mm along a line.
constexpr std::size_t kNeighbors = 16;
constexpr double kFalseAlarms = 0.01;

/// Share of the bare samples above the value that kFalseAlarms of the sprayed ones exceed.
double detected(const Samples& bare, const Samples& sprayed, ShapeProperty which,
                std::size_t neighbors) {
  std::vector<double> usual = means_of(sprayed, which, neighbors);
  const std::vector<double> found = means_of(bare, which, neighbors);
  if (usual.empty() || found.empty()) return 0.0;
  std::sort(usual.begin(), usual.end());
  const double limit = quantile_of(usual, 1.0 - kFalseAlarms);
  const auto above =
      std::count_if(found.begin(), found.end(), [limit](double value) { return value > limit; });
  return static_cast<double>(above) / static_cast<double>(found.size());
}

/// The samples of all planes, or of all cusps, at one depth.
Samples gathered(const std::vector<EnamelTrial>& trials, double z_mm, bool cusps,
                 std::size_t surface) {
  Samples all;
  for (const EnamelTrial& trial : trials) {
    if (trial.scene.z_mm != z_mm || trial.scene.is_cusp() != cusps) continue;
    const int first_run = all.empty() ? 0 : all.back().run + 1;
    for (EnamelSample sample : trial.samples[surface]) {
      sample.run += first_run;
      all.push_back(sample);
    }
  }
  return all;
}

Json shape_figures(const Samples& bare, const Samples& sprayed) {
  Json figures;
  for (const ShapeProperty which : kShapeProperties)
    figures[std::string(to_string(which))] = {
        {"single", detected(bare, sprayed, which, 1)},
        {"neighbors", detected(bare, sprayed, which, kNeighbors)}};
  return figures;
}

Json records_of(const std::vector<EnamelTrial>& trials, const std::vector<NamedSurface>& surfaces) {
  Json planes = Json::array(), cusps = Json::array(), shapes = Json::array();
  for (const EnamelTrial& trial : trials) {
    if (trial.scene.is_cusp()) continue;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      Json record = {{"surface", surfaces[i].name},
                     {"z_mm", trial.scene.z_mm},
                     {"tilt_degrees", trial.scene.tilt_degrees}};
      record.update(figures_of(trial.samples[i], trial.samples[0]));
      planes.push_back(std::move(record));
    }
  }
  for (const double z_mm : kDepths_mm) {
    const Samples sprayed = gathered(trials, z_mm, false, 0);
    const Samples sprayed_cusps = gathered(trials, z_mm, true, 0);
    // How far the limits hold on a sprayed surface that is not plane.
    shapes.push_back({{"surface", "sprayed cusp"},
                      {"z_mm", z_mm},
                      {"detected", shape_figures(sprayed_cusps, sprayed)}});
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Json head = {{"surface", surfaces[i].name}, {"z_mm", z_mm}};
      cusps.push_back(head);
      cusps.back().update(figures_of(gathered(trials, z_mm, true, i), sprayed_cusps));
      if (i == 0) continue;
      shapes.push_back(head);
      shapes.back()["detected"] = shape_figures(gathered(trials, z_mm, false, i), sprayed);
    }
  }
  return {{"planes", planes}, {"highlights", cusps}, {"shapes", shapes}};
}

/// A figure as text; "-" where there were no samples.
std::string text(const Json& figures, const char* name, int digits) {
  if (!figures.contains(name)) return "-";
  return fmt::format("{:.{}f}", figures.at(name).get<double>(), digits);
}

/// The share of one count in another.
std::string percent(const Json& figures, const char* part, const char* of) {
  if (!figures.contains(part) || figures.at(of) == 0) return "-";
  return fmt::format("{:.1f}",
                     100.0 * figures.at(part).get<double>() / figures.at(of).get<double>());
}

void print_planes(const Json& planes) {
  fmt::print("{:<20} {:>5} {:>5} {:>10} {:>12} {:>7} {:>7} {:>7}\n", "plane", "z, mm", "tilt",
             "below, µm", "scatter, µm", "lost, %", "width", "height");
  for (const Json& plane : planes) {
    fmt::print("{:<20} {:>5} {:>5} {:>10} {:>12} {:>7.1f} {:>7} {:>7}\n",
               plane.at("surface").get<std::string>(), plane.at("z_mm").get<double>(),
               plane.at("tilt_degrees").get<double>(), text(plane, "below_um", 1),
               text(plane, "scatter_um", 1), 100.0 * plane.at("lost").get<double>(),
               text(plane, "width", 2), text(plane, "height", 2));
  }
}

void print_highlights(const Json& cusps) {
  fmt::print("\n{:<20} {:>5} {:>10} {:>12} {:>9} {:>7} {:>8} {:>13} {:>15}\n", "near a highlight",
             "z, mm", "below, µm", "scatter, µm", "95 %, µm", "lost, %", "off, %", "saturated, %",
             "of those off, %");
  for (const Json& cusp : cusps) {
    fmt::print("{:<20} {:>5} {:>10} {:>12} {:>9} {:>7.1f} {:>8} {:>13} {:>15}\n",
               cusp.at("surface").get<std::string>(), cusp.at("z_mm").get<double>(),
               text(cusp, "below_um", 1), text(cusp, "scatter_um", 1), text(cusp, "error_95_um", 1),
               100.0 * cusp.at("lost").get<double>(), percent(cusp, "off", "samples"),
               percent(cusp, "saturated", "samples"), percent(cusp, "saturated_off", "off"));
  }
}

void print_shapes(const Json& shapes) {
  fmt::print("\n{:<20} {:>5}", "told from sprayed, %", "z, mm");
  for (const ShapeProperty which : kShapeProperties) fmt::print(" {:>12}", to_string(which));
  fmt::print("\n");
  for (const Json& shape : shapes) {
    fmt::print("{:<20} {:>5}", shape.at("surface").get<std::string>(),
               shape.at("z_mm").get<double>());
    for (const ShapeProperty which : kShapeProperties) {
      const Json& rates = shape.at("detected").at(std::string(to_string(which)));
      fmt::print(" {:>12}", fmt::format("{:.0f}; {:.0f}", 100.0 * rates.at("single").get<double>(),
                                        100.0 * rates.at("neighbors").get<double>()));
    }
    fmt::print("\n");
  }
  fmt::print(
      "\nbelow: median depth of the points below the true surface, along its normal.\n"
      "lost: of the points that the sprayed surface gives; width, height: of its lines.\n"
      "tilt: about the lines, above 0 away from the projector.\n"
      "off: more than {} µm from the true surface; of those off: saturated ones.\n"
      "told from sprayed: at {:.0f} % false alarms; a single sample; the mean of {} rows.\n",
      kOff_um, 100.0 * kFalseAlarms, kNeighbors);
}

Result<void> write_files(const EnamelArguments& arguments,
                         const std::vector<NamedSurface>& surfaces, const Json& records) {
  if (!arguments.picture.empty()) {
    const auto picture =
        enamel_picture(simulated::intraoral_sensor(),
                       {surfaces[0].surface, surfaces[1].surface, surfaces.back().surface});
    if (!picture) return tl::unexpected(picture.error());
    auto written = cli::write_drawings({{arguments.picture, *picture}});
    if (!written) return written;
  }
  if (arguments.output.empty()) return {};
  Json document = {{"format", kStudyFormat}, {"version", 1},
                   {"study", "enamel"},      {"images", arguments.image_count},
                   {"seed", arguments.seed}, {"surface_share", arguments.dry_share}};
  document.update(records);
  return io::write_file(arguments.output, document.dump(1) + "\n");
}

Result<void> run(const EnamelArguments& arguments, const Progress& progress) {
  auto checked = cli::check_output_files({}, {{arguments.output, kStudyFormat}}, arguments.force);
  if (!checked) return checked;
  checked = cli::check_drawing_files({arguments.picture}, arguments.force);
  if (!checked) return checked;
  const Workers workers(arguments.thread_count);
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  const auto calibration = simulated::calibrate_virtual_sensor(sensor, workers, progress);
  if (!calibration) return tl::unexpected(calibration.error());
  const std::vector<NamedSurface> surfaces = surfaces_of(arguments.dry_share);
  const auto trials = measure_trials(
      surfaces, {sensor, *calibration, arguments.image_count, arguments.seed}, workers, progress);
  if (!trials) return tl::unexpected(trials.error());
  const Json records = records_of(*trials, surfaces);
  print_planes(records.at("planes"));
  print_highlights(records.at("highlights"));
  print_shapes(records.at("shapes"));
  return write_files(arguments, surfaces, records);
}

}  // namespace

void add_enamel_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<EnamelArguments>();
  CLI::App* command = lab.add_subcommand(
      "enamel",
      "Measure what bare and wet teeth do to the lines, and what their shape shows of it");
  command->add_option("-o,--output", arguments->output, "JSON file for the figures");
  command->add_option("--picture", arguments->picture,
                      "Drawing to write, .svg or .pdf: cross-sections of a line");
  cli::add_force_option(*command, arguments->force);
  command
      ->add_option("--images", arguments->image_count,
                   "Images of each surface at each place, each with other noise")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Random seed of the noise")->capture_default_str();
  command
      ->add_option("--surface-share", arguments->dry_share,
                   "Share of the light that bare, dry teeth reflect at their surface; wet ones "
                   "half of it")
      ->check(CLI::Range(0.05, 1.0))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab enamel -o enamel.json --picture enamel.svg");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
