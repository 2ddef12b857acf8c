/// @file  flytri-lab standard-tests: the tests by which intra-oral scanners are compared, on
///          simulated scans.
/// @source  ISO 20896-1, ISO 12836 and VDI/VDE 2634: trueness and precision over ten repeats,
///          spheres at known distances, noise on a flat.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/lab/reconstructed_scan.h"
#include "app/lab/standard_body.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/base/median.h"
#include "core/evaluation/surface_error.h"
#include "core/geometry/mesh_distance.h"

namespace flytri::lab {
namespace {

using Json = nlohmann::ordered_json;

struct StandardTestArguments {
  SeedArguments seeds;
  int view_count = 500;
  int thread_count = 0;
};

/// Gum is soft and no standard judges it.
constexpr double kAboveNeck_mm = 2.0;
constexpr std::size_t kPlaceCount = 2000;
/// Surface farther off is that of another place.
constexpr double kNear_mm = 0.1;

/// A place on a crown.
struct Place {
  double along_mm = 0.0;  ///< the arch, from its middle
  Vec3 position_mm = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
};

struct Jaw {
  sample_jaw::Dentition dentition;
  TriangleMesh surface;
  std::vector<Place> places;
  StandardBody body;
};

std::vector<Place> choose_places(const TriangleMesh& surface,
                                 const sample_jaw::Dentition& dentition) {
  constexpr double kOnSurface_mm = 0.2;
  std::vector<Place> on_crowns;
  for (const SurfacePoint& vertex : surface.vertices) {
    const Vec3 p_mm = vertex.position_mm.cast<double>();
    const bool is_on_crown =
        std::any_of(dentition.teeth.begin(), dentition.teeth.end(), [&](const auto& tooth) {
          return tooth.to_tooth(p_mm).z() > kAboveNeck_mm && std::abs(tooth(p_mm)) < kOnSurface_mm;
        });
    if (!is_on_crown) continue;
    on_crowns.push_back(
        {dentition.arch.locate(p_mm.head<2>()).along_mm, p_mm, vertex.normal.cast<double>()});
  }
  std::vector<Place> chosen;
  for (std::size_t i = 0; i < kPlaceCount; ++i) {
    chosen.push_back(on_crowns[i * on_crowns.size() / kPlaceCount]);
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const Place& a, const Place& b) { return a.along_mm < b.along_mm; });
  return chosen;
}

Result<Jaw> make_jaw(const Workers& workers) {
  const sample_jaw::SampleJawOptions options;
  auto surface = sample_jaw::make_sample_jaw(options, workers);
  if (!surface) return tl::unexpected(surface.error());
  auto dentition = sample_jaw::make_dentition(options.kind, options.seed);
  auto places = choose_places(*surface, dentition);
  auto body = make_standard_body(*surface, dentition);
  return Jaw{std::move(dentition), *std::move(surface), std::move(places), std::move(body)};
}

/// A scan's surface in the frame of the model.
Result<TriangleMesh> scan_surface(const TriangleMesh& model, const StandardTestArguments& arguments,
                                  std::uint64_t seed, const Workers& workers,
                                  const Progress& progress) {
  const auto scan =
      scan_arch(model, JawKind::kUpper, arguments.view_count, seed, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  return evaluation::transformed(scan->surface, scan->T_model_world);
}

double hundredths(double value) { return std::round(1e2 * value) / 1e2; }

/// By how much a scan's surface is too high at each place: [along the arch in mm, µm], or null
/// where nothing was scanned.
Json deviations(const TriangleMesh& scanned, const std::vector<Place>& places) {
  const MeshDistance distance(scanned);
  Json all = Json::array();
  for (const Place& place : places) {
    const auto closest = distance.closest(place.position_mm.cast<float>(), kNear_mm);
    const double off_mm = place.normal.dot(closest.point_mm.cast<double>() - place.position_mm);
    all.push_back({hundredths(place.along_mm), std::isfinite(closest.distance_mm)
                                                   ? Json(hundredths(kMicrons * off_mm))
                                                   : Json()});
  }
  return all;
}

/// The spheres and the plate of a scanned body.
Result<Json> body_figures(const TriangleMesh& scanned, const StandardBody& body) {
  std::vector<FittedSphere> fitted;
  Json spheres = Json::array(), distances = Json::array();
  for (std::size_t i = 0; i < body.spheres_mm.size(); ++i) {
    const auto sphere = fit_sphere(scanned, body, i);
    if (!sphere) return tl::unexpected(sphere.error());
    for (std::size_t k = 0; k < i; ++k) {
      const double true_mm = (body.spheres_mm[i] - body.spheres_mm[k]).norm();
      const double error_mm = (sphere->center_mm - fitted[k].center_mm).norm() - true_mm;
      distances.push_back(
          {{"between", {k + 1, i + 1}}, {"length_mm", true_mm}, {"error_um", kMicrons * error_mm}});
    }
    spheres.push_back({{"diameter_error_um", 2.0 * kMicrons * (sphere->radius_mm - body.radius_mm)},
                       {"form_um", kMicrons * sphere->rms_mm}});
    fitted.push_back(*sphere);
  }
  const auto noise_mm = plate_noise_mm(scanned, body);
  if (!noise_mm) return tl::unexpected(noise_mm.error());
  return Json{{"spheres", std::move(spheres)},
              {"distances", std::move(distances)},
              {"plate_um", kMicrons * *noise_mm}};
}

Result<Json> measure(const StandardTestArguments& arguments, const Jaw& jaw, std::uint64_t seed,
                     const Workers& workers, const Progress& progress) {
  const auto scanned = scan_surface(jaw.surface, arguments, seed, workers, progress);
  if (!scanned) return tl::unexpected(scanned.error());
  const auto scanned_body = scan_surface(jaw.body.surface, arguments, seed, workers, progress);
  if (!scanned_body) return tl::unexpected(scanned_body.error());
  auto body = body_figures(*scanned_body, jaw.body);
  if (!body) return body;
  return Json{{"views", arguments.view_count},
              {"body", *std::move(body)},
              {"places", deviations(*scanned, jaw.places)}};
}

/// Median and largest, as "2.4 (2.9)".
std::string median_and_largest(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return fmt::format("{:.1f} ({:.1f})", quantile_of(values, 0.5), values.back());
}

/// What the deviations of all scans say together, µm.
struct Deviations {
  std::vector<double> rms, median;           ///< by scan
  std::vector<double> between;               ///< RMS difference, by pair of scans
  std::vector<double> bias;                  ///< mean over the scans, by place
  std::size_t place_count = 0, missing = 0;  ///< of all scans
};

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

Deviations judge(const Json& records) {
  Deviations all;
  for (std::size_t a = 0; a < records.size(); ++a) {
    const Json& places = records[a].at("places");
    std::vector<double> off;
    for (const Json& place : places) {
      ++all.place_count;
      if (place.at(1).is_null()) {
        ++all.missing;
      } else {
        off.push_back(place.at(1));
      }
    }
    if (off.empty()) continue;
    all.rms.push_back(rms(off));
    for (double& value : off) value = std::abs(value);
    all.median.push_back(median_of(off));
    for (std::size_t b = 0; b < a; ++b) {
      const Json& others = records[b].at("places");
      std::vector<double> difference;
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (places.at(i).at(1).is_null() || others.at(i).at(1).is_null()) continue;
        difference.push_back(places[i][1].get<double>() - others[i][1].get<double>());
      }
      if (!difference.empty()) all.between.push_back(rms(difference));
    }
  }
  const std::size_t count = records.front().at("places").size();
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0, scans = 0.0;
    for (const Json& record : records) {
      const Json& off = record.at("places").at(i).at(1);
      if (off.is_null()) continue;
      sum += off.get<double>();
      scans += 1.0;
    }
    if (scans > 0.0) all.bias.push_back(sum / scans);
  }
  return all;
}

void print_row(const std::string& name, const std::string& figure) {
  fmt::print("{:<52} {:>16}\n", name, figure);
}

}  // namespace

void print_standard_tests(const Json& records) {
  const Deviations all = judge(records);
  fmt::print("\n{} scans of {} views of each body; µm, median and largest\n", records.size(),
             records.front().at("views").get<int>());
  if (!all.rms.empty()) {
    print_row("trueness: crowns to the true surface, RMS", median_and_largest(all.rms));
    print_row("the same, median distance", median_and_largest(all.median));
    print_row("mean over all scans, RMS of its places", fmt::format("{:.1f}", rms(all.bias)));
  }
  if (!all.between.empty()) {
    print_row("precision: between two scans, RMS", median_and_largest(all.between));
  }
  print_row("places on crowns without surface, %",
            fmt::format("{:.2f}", 100.0 * static_cast<double>(all.missing) /
                                      static_cast<double>(all.place_count)));
  std::vector<double> diameters, forms, plates;
  for (const Json& record : records) {
    const Json& body = record.at("body");
    plates.push_back(body.at("plate_um"));
    for (const Json& sphere : body.at("spheres")) {
      diameters.push_back(std::abs(sphere.at("diameter_error_um").get<double>()));
      forms.push_back(sphere.at("form_um"));
    }
  }
  print_row("noise on a flat, RMS", median_and_largest(plates));
  print_row("spheres: error of the diameter", median_and_largest(diameters));
  print_row("spheres: form, RMS", median_and_largest(forms));
  const Json& distances = records.front().at("body").at("distances");
  for (std::size_t i = 0; i < distances.size(); ++i) {
    std::vector<double> errors;
    for (const Json& record : records) {
      errors.push_back(
          std::abs(record.at("body").at("distances").at(i).at("error_um").get<double>()));
    }
    print_row(fmt::format("distance of spheres {} and {}, {:.1f} mm: error",
                          distances[i].at("between").at(0).get<int>(),
                          distances[i].at("between").at(1).get<int>(),
                          distances[i].at("length_mm").get<double>()),
              median_and_largest(errors));
  }
}

void add_standard_tests_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<StandardTestArguments>();
  CLI::App* command = lab.add_subcommand(
      "standard-tests",
      "Run the tests by which scanners are compared: trueness, precision, spheres, a flat");
  add_seed_options(*command, arguments->seeds, "--scans",
                   "Repeats, each along another path, of a jaw and of a body with spheres");
  command->add_option("--views", arguments->view_count, "Views of each scan")
      ->check(CLI::Range(100, 5000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab standard-tests -o standard-tests.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) -> Result<void> {
      const Workers workers(arguments->thread_count);
      const auto jaw = make_jaw(workers);
      if (!jaw) return tl::unexpected(jaw.error());
      const SeededStudy tests = {{{"views", arguments->view_count}}, [&](std::uint64_t seed) {
                                   return measure(*arguments, *jaw, seed, workers, progress);
                                 }};
      return run_seeds(tests, kStandardTestsPrinter, arguments->seeds);
    };
  });
}

}  // namespace flytri::lab
