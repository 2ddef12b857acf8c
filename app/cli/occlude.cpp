/// @file  flytri occlude: brings the two jaws together as they bite.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "app/cli/case_access.h"
#include "app/cli/case_part.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "core/evaluation/surface_error.h"
#include "core/io/calibrations/recording_calibration.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/io/recordings/recording.h"
#include "core/occlusion/close_jaws.h"
#include "core/reconstruct/reconstruct.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kOcclusionFormat = "flytri.occlusion";
constexpr int kOcclusionVersion = 1;
/// For the report: nearer is contact.
constexpr double kContact_mm = 0.02;

struct OccludeArguments {
  fs::path case_path;  ///< empty: recordings
  CaseArguments case_options;
  fs::path upper, lower;
  std::vector<fs::path> bites;
  fs::path calibration;
  fs::path output, report;
  bool force = false;
  int thread_count = 0;
};

struct Parts {
  Part upper, lower;
  std::vector<Part> bites;
};

Result<Part> reconstruct_part(const fs::path& folder, const OccludeArguments& arguments,
                              const Workers& workers, const Progress& progress) {
  const Result<io::Recording> recording = io::open_recording(folder);
  if (!recording) return tl::unexpected(recording.error());
  const auto used = io::calibration_of(*recording, arguments.calibration);
  if (!used) return tl::unexpected(used.error());
  auto made = reconstruct::reconstruct(*recording, used->calibration, {}, workers, progress);
  if (!made) return tl::unexpected(made.error());
  return Part{folder.string(), std::move(made->surface.mesh), std::move(made->model)};
}

Result<Parts> reconstruct_parts(const OccludeArguments& arguments, const Workers& workers,
                                const Progress& progress) {
  Parts parts;
  auto upper = reconstruct_part(arguments.upper, arguments, workers, progress);
  if (!upper) return tl::unexpected(upper.error());
  parts.upper = *std::move(upper);
  auto lower = reconstruct_part(arguments.lower, arguments, workers, progress);
  if (!lower) return tl::unexpected(lower.error());
  parts.lower = *std::move(lower);
  for (const fs::path& folder : arguments.bites) {
    auto bite = reconstruct_part(folder, arguments, workers, progress);
    if (!bite) return tl::unexpected(bite.error());
    parts.bites.push_back(*std::move(bite));
  }
  return parts;
}

/// Those that are finished.
Result<std::vector<Part>> load_bites(io::CaseFile& file) {
  std::vector<Part> bites;
  for (const io::ScanStage stage : io::kBites) {
    const Result<io::StageCounts> counts = file.counts(stage);
    if (!counts) return tl::unexpected(counts.error());
    if (!counts->has_result) continue;
    auto bite = load_part(file, stage);
    if (!bite) return tl::unexpected(bite.error());
    bites.push_back(*std::move(bite));
  }
  if (!bites.empty()) return bites;
  // Its message says how to make the model.
  return load_part(file, io::ScanStage::kBite).map([](Part&& bite) {
    return std::vector<Part>{std::move(bite)};
  });
}

Result<Parts> load_parts(CaseAccess& access) {
  Result<io::CaseFile> file = access.open(true);
  if (!file) return tl::unexpected(file.error());
  auto upper = load_part(*file, io::ScanStage::kUpper);
  if (!upper) return tl::unexpected(upper.error());
  auto lower = load_part(*file, io::ScanStage::kLower);
  if (!lower) return tl::unexpected(lower.error());
  auto bites = load_bites(*file);
  if (!bites) return tl::unexpected(bites.error());
  return Parts{*std::move(upper), *std::move(lower), *std::move(bites)};
}

Json place_json(const occlusion::Occlusion& occlusion, const Vec3& p_mm) {
  return {{"place_mm", {p_mm.x(), p_mm.y(), p_mm.z()}},
          {"uncertainty_mm", occlusion.uncertainty_mm(p_mm)}};
}

double rotation_uncertainty_deg(const occlusion::Occlusion& occlusion) {
  return occlusion.rotation_uncertainty_rad() * 180.0 / std::numbers::pi;
}

Json report_json(const occlusion::ClosedJaws& jaws, const Parts& parts,
                 const occlusion::Contact& contact) {
  const occlusion::Occlusion& occlusion = jaws.occlusion;
  const Eigen::Quaterniond q(occlusion.T_upper_lower.linear());
  const Vec3 t = occlusion.T_upper_lower.translation();
  Json json = {{"format", kOcclusionFormat}, {"version", kOcclusionVersion}};
  json["T_upper_lower"] = {{"q_wxyz", {q.w(), q.x(), q.y(), q.z()}},
                           {"t_mm", {t.x(), t.y(), t.z()}}};
  json["middle"] = place_json(occlusion, occlusion.middle_mm);
  json["least_certain"] = place_json(occlusion, jaws.least_certain_mm);
  json["rotation_uncertainty_deg"] = rotation_uncertainty_deg(occlusion);
  json["bites"] = Json::array();
  for (std::size_t i = 0; i < occlusion.bites.size(); ++i) {
    const occlusion::BiteFit& bite = occlusion.bites[i];
    json["bites"].push_back({{"name", parts.bites[i].name},
                             {"on_upper", bite.upper_share},
                             {"on_lower", bite.lower_share},
                             {"agreement_upper", bite.upper_agreement},
                             {"agreement_lower", bite.lower_agreement},
                             {"rms_mm", bite.rms_mm}});
  }
  json["contact"] = {{"nearer_than_mm", kContact_mm},
                     {"area_mm2", contact.area_mm2},
                     {"penetration_area_mm2", contact.penetration_area_mm2},
                     {"deepest_penetration_mm", contact.deepest_mm}};
  return json;
}

void print_occlusion(const occlusion::ClosedJaws& jaws, const Parts& parts,
                     const occlusion::Contact& contact) {
  const occlusion::Occlusion& occlusion = jaws.occlusion;
  for (std::size_t i = 0; i < occlusion.bites.size(); ++i) {
    const occlusion::BiteFit& bite = occlusion.bites[i];
    print_out("{}: {:.0f} % on the upper jaw, {:.0f} % on the lower jaw, RMS {:.1f} µm\n",
              parts.bites[i].name, 100.0 * bite.upper_share, 100.0 * bite.lower_share,
              1e3 * bite.rms_mm);
  }
  const Vec3& worst_mm = jaws.least_certain_mm;
  print_out(
      "uncertainty of the lower jaw: {:.0f} µm in the middle of the bite, {:.0f} µm where it is "
      "largest, {:.0f} mm from there; {:.3f} degrees\n",
      1e3 * occlusion.uncertainty_mm(occlusion.middle_mm), 1e3 * occlusion.uncertainty_mm(worst_mm),
      (worst_mm - occlusion.middle_mm).norm(), rotation_uncertainty_deg(occlusion));
  print_out("contact (nearer than {:.0f} µm): {:.1f} mm²; deepest penetration: {:.0f} µm\n",
            1e3 * kContact_mm, contact.area_mm2, 1e3 * contact.deepest_mm);
}

Result<void> write_occlusion(const OccludeArguments& arguments, const occlusion::ClosedJaws& jaws,
                             const Parts& parts, const occlusion::Contact& contact) {
  TexturedMesh lower = parts.lower.model;
  lower.mesh = evaluation::transformed(lower.mesh, jaws.occlusion.T_upper_lower);
  const std::array models = {io::NamedModel{"upper", &parts.upper.model},
                             io::NamedModel{"lower", &lower}};
  const Result<std::string> glb = io::encode_glb_scene(models, arguments.output.string());
  if (!glb) return tl::unexpected(glb.error());
  if (auto written = io::write_file(arguments.output, *glb, io::Access::kOwnerOnly); !written)
    return written;
  print_out("wrote {}\n", arguments.output.string());
  if (arguments.report.empty()) return {};
  const std::string text = report_json(jaws, parts, contact).dump(1) + "\n";
  auto written = io::write_file(arguments.report, text, io::Access::kOwnerOnly);
  if (written) print_out("wrote {}\n", arguments.report.string());
  return written;
}

Result<void> check_arguments(const OccludeArguments& arguments) {
  const bool has_recordings =
      !arguments.upper.empty() && !arguments.lower.empty() && !arguments.bites.empty();
  const bool has_some =
      !arguments.upper.empty() || !arguments.lower.empty() || !arguments.bites.empty();
  if (arguments.case_path.empty() ? !has_recordings : has_some) {
    return fail(ErrorCode::kBadOption,
                "give either a case, or --upper, --lower and --bite with a recording each");
  }
  if (arguments.output.extension() != ".glb")
    return fail(ErrorCode::kBadOption, "{}: both jaws in one file need .glb",
                arguments.output.string());
  return check_output_files({arguments.output}, {{arguments.report, kOcclusionFormat}},
                            arguments.force);
}

Result<void> occlude(const OccludeArguments& arguments, const Parts& parts, const Workers& workers,
                     const Progress& progress) {
  std::vector<occlusion::BiteScan> bites;
  for (const Part& bite : parts.bites) bites.push_back({bite.name, bite.surface.vertices});
  const auto jaws =
      occlusion::close_jaws(parts.upper.surface, parts.lower.surface, bites, {}, workers, progress);
  if (!jaws) return tl::unexpected(jaws.error());
  const occlusion::Contact contact =
      occlusion::contact_of(parts.lower.surface, jaws->lower, kContact_mm);
  print_occlusion(*jaws, parts, contact);
  return write_occlusion(arguments, *jaws, parts, contact);
}

Result<void> occlude_recordings(const OccludeArguments& arguments, const Workers& workers,
                                const Progress& progress) {
  return reconstruct_parts(arguments, workers, progress).and_then([&](const Parts& parts) {
    return occlude(arguments, parts, workers, progress);
  });
}

Result<void> occlude_case(const OccludeArguments& arguments, const Workers& workers,
                          const Progress& progress) {
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  Result<void> done = load_parts(*access).and_then(
      [&](const Parts& parts) { return occlude(arguments, parts, workers, progress); });
  if (done) access->note(io::CaseAction::kExported, std::nullopt, {arguments.output});
  access->write_notes();
  return done;
}

Result<void> run(const OccludeArguments& arguments, const Progress& progress) {
  if (auto checked = check_arguments(arguments); !checked) return checked;
  const Workers workers(arguments.thread_count);
  return arguments.case_path.empty() ? occlude_recordings(arguments, workers, progress)
                                     : occlude_case(arguments, workers, progress);
}

}  // namespace

void add_occlude_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<OccludeArguments>();
  CLI::App* command = app.add_subcommand("occlude", "Bring the jaws together as they bite");
  command->add_option(
      "CASE", arguments->case_path,
      "A case (.flytri) with finished scans of the upper jaw, the lower jaw and one bite or "
      "two");
  command->add_option("--upper", arguments->upper,
                      "Recording of the upper jaw, in place of a case");
  command->add_option("--lower", arguments->lower, "Recording of the lower jaw");
  command->add_option("--bite", arguments->bites,
                      "Recording of the closed jaws from the cheek; once or once a side");
  command->add_option("--calibration", arguments->calibration,
                      "Calibration of the sensor. Default: the one that each recording names");
  command->add_option("-o,--output", arguments->output, "Model of both jaws to write: .glb")
      ->required();
  command->add_option("--report", arguments->report,
                      "Also write relation, uncertainty and contact as .json");
  add_passphrase_option(*command, arguments->case_options);
  add_force_option(*command, arguments->force);
  add_threads_option(*command, arguments->thread_count);
  command->footer(
      "Example: flytri occlude --upper scans/upper --lower scans/lower --bite scans/bite "
      "--calibration calibration.json -o both.glb --report occlusion.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
