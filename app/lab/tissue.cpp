/// @file  flytri-lab tissue: how soon the live surface loses what moved through the view.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "app/lab/studies.h"
#include "core/geometry/cell_key.h"
#include "core/geometry/mesh_distance.h"
#include "core/io/calibrations/recording_calibration.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/ply.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "core/live/live_surface.h"
#include "core/measurement/measure_view.h"
#include "core/tracking/registrar.h"

namespace flytri::lab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct TissueArguments {
  fs::path recording, calibration, output;
  bool force = false;
  live::LiveSurfaceOptions surface;
};

/// Farther from the object than any error of a live scan: mm.
constexpr float kStray_mm = 0.3F;
/// Between two comparisons, s, and how much later what had been there is looked for.
constexpr double kLookPeriod_s = 0.25, kLater_s = 2.0;

using Places = std::set<CellKey>;  // of surfels, by cell: a surfel never leaves its cell

/// What a surface shows: near the true surface, and elsewhere.
struct Shown {
  Places true_surface, stray;
};

/// The live surface at one time, with crossed surfels hidden, and with all of them.
struct Moment {
  double time_s = 0.0;
  Shown all, uncrossed;
};

std::size_t count_common(const Places& one, const Places& other) {
  return static_cast<std::size_t>(std::count_if(
      one.begin(), one.end(), [&](const CellKey& key) { return other.contains(key); }));
}

double share(std::size_t part, std::size_t of) {
  return of > 0 ? static_cast<double>(part) / static_cast<double>(of) : 0.0;
}

/// Frame by frame, as the live scan does it on one thread.
class TissueTrial {
 public:
  TissueTrial(const io::Recording& recording, const io::Truth& truth, const TriangleMesh& object,
              const calibration::Calibration& calibration, tracking::Registrar registrar,
              const live::LiveSurfaceOptions& options)
      : recording_(recording),
        truth_(truth),
        object_(object),
        calibration_(calibration),
        registrar_(std::move(registrar)),
        options_(options) {
    restart();
  }

  /// @errors  as load_frame and measure_view.
  [[nodiscard]] Result<std::vector<Moment>> run(const Progress& progress) {
    std::vector<Moment> moments;
    progress.begin_stage("Scanning", static_cast<std::int64_t>(recording_.frames.size()));
    double next_s = 0.0;
    for (std::size_t i = 0; i < recording_.frames.size(); ++i, progress.advance()) {
      if (progress.cancelled()) return stopped();
      if (auto added = add_frame(FrameIndex(i)); !added) return tl::unexpected(added.error());
      if (recording_.frames[i].time_s < next_s || !T_model_world_) continue;
      next_s = recording_.frames[i].time_s + kLookPeriod_s;
      moments.push_back(look(recording_.frames[i].time_s));
    }
    if (T_model_world_) moments.push_back(look(recording_.frames.back().time_s));
    return moments;
  }

 private:
  void restart() { surface_ = live::LiveSurface::create(options_, calibration_).value(); }

  Result<void> add_frame(FrameIndex index) {
    if (recording_.frames[index.value].kind == FrameKind::kTexture) return {};
    const auto frame = io::load_frame(recording_, index);
    if (!frame) return tl::unexpected(frame.error());
    auto measured = measurement::measure_view(*frame, calibration_, {});
    if (!measured) return tl::unexpected(measured.error());
    if (measured->outcome != measurement::MeasureOutcome::kMeasured) return {};
    registrar_.add(std::make_shared<const View>(std::move(measured->view)));
    const tracking::ScanGrowth growth = registrar_.take_growth();
    if (growth.is_all) restart();
    for (const AlignedView& view : growth.added) surface_->add(view);
    if (growth.added.empty() || (T_model_world_ && !growth.is_all)) return {};
    const AlignedView& first = growth.added.front();
    for (const io::TruthPose& pose : truth_.poses) {
      if (pose.frame == first.view->frame) {
        T_model_world_ = pose.T_model_sensor * first.T_world_sensor.inverse();
      }
    }
    return {};
  }

  [[nodiscard]] Moment look(double time_s) {
    Moment moment{time_s, {}, shown()};
    surface_->show_crossed(true);
    moment.all = shown();
    surface_->show_crossed(false);
    return moment;
  }

  [[nodiscard]] Shown shown() const {
    Shown shown;
    for (const SurfacePoint& point : surface_->points()) {
      const Vec3f p_mm = (*T_model_world_ * point.position_mm.cast<double>()).cast<float>();
      const CellKey place = CellKey::at(point.position_mm, surface_->cell_mm());
      (object_.is_within(p_mm, kStray_mm) ? shown.true_surface : shown.stray).insert(place);
    }
    return shown;
  }

  const io::Recording& recording_;
  const io::Truth& truth_;
  MeshDistance object_;
  const calibration::Calibration& calibration_;
  tracking::Registrar registrar_;
  live::LiveSurfaceOptions options_;
  std::optional<live::LiveSurface> surface_;
  std::optional<Isometry> T_model_world_;
};

/// The latest moment at least kLater_s before.
const Moment* before(const std::vector<Moment>& moments, double time_s) {
  const Moment* found = nullptr;
  for (const Moment& moment : moments) {
    if (moment.time_s <= time_s - kLater_s) found = &moment;
  }
  return found;
}

Json to_json(const std::vector<Moment>& moments) {
  Json all = Json::array();
  for (const Moment& now : moments) {
    Json record = {{"time_s", now.time_s},
                   {"stray_seen", now.all.stray.size()},
                   {"stray_shown", now.uncrossed.stray.size()},
                   {"true_seen", now.all.true_surface.size()},
                   {"true_shown", now.uncrossed.true_surface.size()}};
    if (const Moment* then = before(moments, now.time_s)) {
      record["stray_seen_2_s_before"] = then->all.stray.size();
      record["of_these_shown"] = count_common(then->all.stray, now.uncrossed.stray);
    }
    all.push_back(std::move(record));
  }
  return all;
}

void print(const std::vector<Moment>& moments) {
  fmt::print("{:>7} {:>12} {:>12} {:>22} {:>14}\n", "time, s", "stray seen", "stray shown",
             "seen 2 s before, gone", "true, hidden");
  for (const Moment& now : moments) {
    const Moment* then = before(moments, now.time_s);
    const std::string gone =
        then == nullptr || then->all.stray.empty()
            ? "-"
            : fmt::format("{:.1f} %",
                          100.0 - 100.0 * share(count_common(then->all.stray, now.uncrossed.stray),
                                                then->all.stray.size()));
    fmt::print(
        "{:>7.2f} {:>12} {:>12} {:>22} {:>12.3f} %\n", now.time_s, now.all.stray.size(),
        now.uncrossed.stray.size(), gone,
        100.0 - 100.0 * share(now.uncrossed.true_surface.size(), now.all.true_surface.size()));
  }
  fmt::print(
      "Numbers of surfels. stray: more than {} mm from the true surface.\n"
      "hidden: views have looked through it, or light it and see nothing there.\n",
      kStray_mm);
}

Result<void> run(const TissueArguments& arguments, const Progress& progress) {
  if (auto checked =
          cli::check_output_files({}, {{arguments.output, kStudyFormat}}, arguments.force);
      !checked) {
    return checked;
  }
  const auto recording = io::open_recording(arguments.recording);
  if (!recording) return tl::unexpected(recording.error());
  const auto truth = io::read_truth(arguments.recording / "truth.json");
  if (!truth) return tl::unexpected(truth.error());
  const auto object = io::read_ply(truth->mesh);
  if (!object) return tl::unexpected(object.error());
  const auto used = io::calibration_of(*recording, arguments.calibration);
  if (!used) return tl::unexpected(used.error());
  auto registrar = tracking::Registrar::create();
  if (!registrar) return tl::unexpected(registrar.error());
  TissueTrial trial(*recording, *truth, object->mesh, used->calibration, std::move(*registrar),
                    arguments.surface);
  const auto moments = trial.run(progress);
  if (!moments) return tl::unexpected(moments.error());
  if (moments->empty()) {
    return fail(ErrorCode::kInsufficient, "{}: no frame could be registered",
                arguments.recording.string());
  }
  print(*moments);
  if (arguments.output.empty()) return {};
  const Json document = {{"format", kStudyFormat},
                         {"version", 1},
                         {"study", "tissue"},
                         {"recording", arguments.recording.string()},
                         {"moments", to_json(*moments)}};
  return io::write_file(arguments.output, document.dump(1) + "\n");
}

}  // namespace

void add_tissue_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<TissueArguments>();
  CLI::App* command = lab.add_subcommand(
      "tissue", "Measure how soon the live surface loses a tongue or a finger that has gone");
  command
      ->add_option("recording", arguments->recording, "Folder of a recording with its truth.json")
      ->required();
  command->add_option("--calibration", arguments->calibration,
                      "calibration.json, if the recording does not name it");
  command
      ->add_option("--free-views", arguments->surface.free_views,
                   "Views that must look through a surfel before it is hidden; 0: never")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--missing-views", arguments->surface.missing_views,
                   "Views that must light a place and see nothing there to hide it; 0: never")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "JSON file for the figures");
  cli::add_force_option(*command, arguments->force);
  command->footer("Example: flytri-lab tissue recording -o tissue.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
