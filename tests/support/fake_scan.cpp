#include "tests/support/fake_scan.h"

#include <algorithm>
#include <array>
#include <functional>

#include "core/io/models/model_formats.h"
#include "tests/support/fake_calibration.h"
#include "tests/support/fake_devices.h"
#include "tests/support/fake_jaw.h"
#include "tests/support/fake_occlusion.h"
#include "tests/support/fake_setup.h"
#include "ui/state/command.h"

namespace flytri::testing {
namespace {

using ui::AppView;

std::shared_ptr<const calibration::Calibration> calibration_in_use() {
  auto calibration = std::make_shared<calibration::Calibration>();
  calibration->history = {"2031-03-01T08:30:00Z",
                          "21 °C",
                          {{"2031-04-02T07:10:00Z", true, "23 °C"}},
                          {{"2030-11-12T09:00:00Z",
                            "",
                            {{"2031-02-27T16:20:00Z", false, "after a fall"}},
                            "2031-03-01T08:30:00Z",
                            "calibration-until-2031-03-01-083000.json"}}};
  return calibration;
}

/// Common part of all states: a case, a simulated sensor, older cases.
AppView ordinary_view() {
  AppView view;
  view.file.path = "/home/clinic/cases/Rivera-2031.flytri";
  view.file.fields = {"Ana Rivera", "2031", "1984-03-12", "Dr. Lindqvist", "Crown 26", ""};
  view.file.folder = "/home/clinic/cases";
  view.file.known = {
      {"/home/clinic/cases/Rivera-2031.flytri", "Ana Rivera", "Today 10:42", false},
      {"/home/clinic/cases/Okafor-2030.flytri", "Chidi Okafor", "Today 09:15", false},
      {"/home/clinic/cases/case-17.flytri", "", "Yesterday 16:30", true}};
  view.stage_has_data = {true};
  view.source.name = "virtual sensor";
  view.source.is_running = true;
  view.source.hand = ui::SimulatedHand{};
  view.calibration.emplace();
  view.calibration->folder = "/home/clinic/.local/share/flytri/calibrations/2031-05-02-081214";
  view.calibration->calibration = calibration_in_use();
  view.calibration->why_not_used = "the virtual sensor has its own calibration";
  view.recording.folder = "/home/clinic/.local/share/flytri/recordings";
  view.recording.is_possible = true;
  view.exports.folder = "/home/clinic/exports";
  view.exports.name = "Rivera-2031-upper";
  return view;
}

scan::ScanSnapshot ordinary_scan(const FakeJaw& jaw) {
  scan::ScanSnapshot scan;
  scan.number = 1;
  scan.phase = scan::ScanPhase::kMeasurement;
  scan.time_s = 84.0;
  scan.scanned_s = 84.0;
  scan.counts = {.offered = 2520,
                 .previewed = 40,
                 .registered = 2301,
                 .interpolated = 96,
                 .textured = 72,
                 .skipped = 0,
                 .pending = 1,
                 .rejected = {{"too few points", 8}, {"no overlap", 2}}};
  scan.latency = {0.046, 0.081, 300};
  scan.latest = {jaw.live_frame(Pattern::kVertical), jaw.live_frame(Pattern::kHorizontal)};
  scan.distance = scan::SensorDistance{0.12, 0.9};
  scan.residual_mm = 0.021;
  scan.T_world_sensor = jaw.T_world_sensor();
  scan.model = jaw.surfels();
  scan.good_share = 0.87;
  scan.area_mm2 = 2600.0;
  scan.holes = jaw.holes();
  scan.holes_are_current = true;
  scan.jaw = jaw_axes(scan.model);
  scan.can_undo = true;
  return scan;
}

/// Sizes of exported files, in the order of io::model_formats(), as rough as the program's
/// estimate.
void add_sizes(AppView& view, bool is_finished) {
  if (is_finished)
    view.exports.densities = {{{1'612'000}, {248'000, 0.0017, 0.0095}, {61'000, 0.0084, 0.0475}}};
  std::uint64_t bytes = 9'800'000;
  for (const io::ModelFormat& format : io::model_formats()) {
    if (is_finished || format.write_points != nullptr) {
      view.exports.estimated_bytes[format.extension] = bytes;
    }
    bytes += 2'600'000;
  }
}

void set_scan(AppView& view, scan::ScanSnapshot scan) {
  view.scan = std::make_shared<const scan::ScanSnapshot>(std::move(scan));
}

}  // namespace

struct FakeScan::Parts {
  FakeJaw jaw;
  std::shared_ptr<const ui::JawPair> pair = fake_pair(jaw.result()->surface.mesh);
  std::shared_ptr<const reconstruct::FinishedScan> prepared_model = jaw.prepared();
  FakeReview review{prepared_model};
  AppView reviewed_view = review_all();

  [[nodiscard]] AppView preview() const {
    AppView view = ordinary_view();
    scan::ScanSnapshot scan = ordinary_scan(jaw);
    scan.model.clear();
    scan.phase = scan::ScanPhase::kPreview;
    scan.scanned_s = 0.0;
    scan.counts = {};
    scan.counts.offered = scan.counts.previewed = 40;
    scan.holes.clear();
    scan.residual_mm.reset();
    scan.T_world_sensor.reset();
    scan.can_undo = false;
    set_scan(view, std::move(scan));
    view.is_scanning = true;
    view.stage_has_data = {};
    return view;
  }

  [[nodiscard]] AppView scanning() const {
    AppView view = ordinary_view();
    set_scan(view, ordinary_scan(jaw));
    view.is_scanning = true;
    view.file.is_saved = false;
    add_sizes(view, false);
    return view;
  }

  [[nodiscard]] AppView too_near() const {
    AppView view = scanning();
    scan::ScanSnapshot scan = *view.scan;
    scan.distance = scan::SensorDistance{-0.8, 0.5};
    set_scan(view, std::move(scan));
    return view;
  }

  [[nodiscard]] AppView flat() const {
    AppView view = scanning();
    scan::ScanSnapshot scan = *view.scan;
    const Isometry& T_world_sensor = *scan.T_world_sensor;
    scan.surface_hold = {0.7, true,
                         tracking::WeakDirection{T_world_sensor.translation(),
                                                 T_world_sensor.linear().col(0), false}};
    set_scan(view, std::move(scan));
    return view;
  }

  [[nodiscard]] AppView tongue_gone() const {
    AppView view = scanning();
    scan::ScanSnapshot scan = *view.scan;
    scan.crossed_count = surfel_count(scan.model) / 50;
    set_scan(view, std::move(scan));
    return view;
  }

  [[nodiscard]] AppView paused() const {
    AppView view = scanning();
    view.is_scanning = false;
    view.file.is_saved = true;
    view.measurements = {jaw.measurement()};
    return view;
  }

  [[nodiscard]] AppView lost() const {
    AppView view = scanning();
    scan::ScanSnapshot scan = *view.scan;
    scan.phase = scan::ScanPhase::kContinuation;
    scan.distance.reset();
    scan.latest = {jaw.other_frame(), nullptr};
    scan.reentry = jaw.reentry_places();
    scan.match_share = 0.42;
    set_scan(view, std::move(scan));
    view.source.hand->follows_path = false;
    return view;
  }

  [[nodiscard]] AppView lost_where_it_is_smooth() const {
    AppView view = lost();
    scan::ScanSnapshot scan = *view.scan;
    const Isometry& T_world_place = scan.reentry.back().first.T_world_sensor;
    scan.lost_sensor = {T_world_place * Eigen::AngleAxisd(0.3, Vec3::UnitX()), true};
    set_scan(view, std::move(scan));
    return view;
  }

  [[nodiscard]] AppView finishing() const {
    AppView view = paused();
    scan::ScanSnapshot scan = *view.scan;
    scan.phase = scan::ScanPhase::kFinishing;
    scan.finishing = {reconstruct::kAligning, 0.37, 48.0};
    set_scan(view, std::move(scan));
    return view;
  }

  [[nodiscard]] AppView finished(const ui::Texts& texts) const {
    AppView view = paused();
    scan::ScanSnapshot scan = *view.scan;
    scan.phase = scan::ScanPhase::kFinished;
    scan.result = jaw.result();
    set_scan(view, std::move(scan));
    add_sizes(view, true);
    view.notices = {{1, ui::Severity::kInformation,
                     texts.fill<ui::Text::kExportedTo>(view.exports.name + ".glb")}};
    return view;
  }

  /// A finished bite, before both jaws are.
  [[nodiscard]] AppView bite(const ui::Texts& texts) const {
    AppView view = finished(texts);
    view.notices.clear();
    view.stage = io::ScanStage::kBite;
    view.stage_has_data = {true, true, true, false};
    view.stage_is_finished = {true, false, true, false};
    view.exports.jaws_name = "Rivera-2031";
    return view;
  }

  [[nodiscard]] AppView closing(const ui::Texts& texts) const {
    AppView view = bite(texts);
    view.stage_is_finished = {true, true, true, false};
    view.occlusion.is_running = true;
    view.occlusion.done_share = 0.4;
    return view;
  }

  [[nodiscard]] AppView jaws(const ui::Texts& texts) const {
    AppView view = closing(texts);
    view.occlusion = {false, 0.0, "", pair, 0.007, 0.061, 52.0};
    return view;
  }

  /// The second bite, before it is scanned.
  [[nodiscard]] AppView other_side(const ui::Texts& texts) const {
    AppView view = preview();
    view.is_scanning = false;
    const AppView before = jaws(texts);
    view.stage = io::ScanStage::kBite2;
    view.stage_has_data = before.stage_has_data;
    view.stage_is_finished = before.stage_is_finished;
    return view;
  }

  [[nodiscard]] AppView two_bites(const ui::Texts& texts) const {
    AppView view = jaws(texts);
    view.stage = io::ScanStage::kBite2;
    view.stage_has_data[index_of(view.stage)] = view.stage_is_finished[index_of(view.stage)] = true;
    view.occlusion.bite_count = 2;
    view.occlusion.far_uncertainty_mm = 0.011;
    view.occlusion.far_mm = 34.0;
    return view;
  }

  /// A copy of the upper jaw on which scan bodies are scanned; the jaw was kept as pre-op, too.
  [[nodiscard]] AppView scan_body() const {
    AppView view = paused();
    view.stage = io::ScanStage::kUpperScanBody;
    for (const io::ScanStage stage :
         {io::ScanStage::kUpper, io::ScanStage::kUpperPreop, io::ScanStage::kUpperScanBody}) {
      view.stage_has_data[index_of(stage)] = true;
    }
    view.stage_is_finished[index_of(io::ScanStage::kUpper)] = true;
    view.stage_is_finished[index_of(io::ScanStage::kUpperPreop)] = true;
    view.exports.name = "Rivera-2031-upper-scanbody";
    return view;
  }

  /// The upper jaw, of which a finished pre-op scan was kept.
  [[nodiscard]] AppView preop() const {
    AppView view = paused();
    const std::size_t preop = index_of(io::ScanStage::kUpperPreop);
    view.stage_has_data[preop] = view.stage_is_finished[preop] = true;
    return view;
  }

  [[nodiscard]] AppView jaws_refused(const ui::Texts& texts) const {
    AppView view = closing(texts);
    view.occlusion = {};
    view.occlusion.failure =
        "Bite: only 4 % of its points lie on the lower jaw (at least 10 % are needed): scan the "
        "teeth of both jaws from the cheek";
    return view;
  }

  /// A finished jaw with a prepared tooth.
  [[nodiscard]] AppView prepared(const ui::Texts& texts) const {
    AppView view = finished(texts);
    scan::ScanSnapshot scan = *view.scan;
    scan.result = prepared_model;
    scan.holes.clear();
    set_scan(view, std::move(scan));
    view.measurements.clear();
    view.notices.clear();
    return view;
  }

  /// All of it is measured once: it takes seconds.
  [[nodiscard]] AppView review_all() const {
    AppView view = prepared({});
    const std::vector<Vec3>& margin_mm = jaw.prepared_jaw().margin_mm;
    const auto at = [&](std::size_t percent) {
      return margin_mm[percent * margin_mm.size() / 100];
    };
    const Vec3 tooth_mm = jaw.prepared_jaw().tooth_mm;
    review.obey(ui::AddMeasurement{{0, at(0), at(50), {}}}, view);
    review.obey(ui::AddMeasurement{{0, at(25), at(75), {}}}, view);
    review.obey(ui::MeasureAngle{{at(0), tooth_mm, at(50)}}, view);
    const Vec3 along = (at(50) - at(0)).normalized(), across = (at(75) - at(25)).normalized();
    const review::Plane plane = {tooth_mm, along};
    review.obey(ui::CutSection{plane, {}}, view);
    review.obey(ui::FindUndercut{{std::nullopt, tooth_mm, 7.0}}, view);
    const std::vector<Vec3> clicks_mm = {at(0), at(20), at(40), at(60), at(80)};
    review.obey(ui::DrawMargin{clicks_mm}, view);
    review.obey(ui::KeepMargin{}, view);
    auto former = *view.review.margins.front().margin;
    for (review::MeasuredPoint& point : former.line.points) point.position_mm += 0.6 * across;
    view.review.margins.push_back({std::make_shared<const review::Margin>(former), true});
    return view;
  }

  [[nodiscard]] AppView reviewed(const ui::Texts& texts) const {
    AppView view = prepared(texts);
    view.measurements = reviewed_view.measurements;
    view.review = reviewed_view.review;
    return view;
  }

  /// The proposed export was asked for.
  [[nodiscard]] AppView exported(std::string_view state, const ui::Texts& texts) const {
    AppView view = finished(texts);
    ui::ExportState& exports = view.exports;
    exports.latest = {exports.folder, exports.name, {".glb", ".ply", ".stl"}};
    exports.has_model = state == "exported";
    if (state == "export_exists") {
      for (const char* extension : {".glb", ".stl"}) {
        exports.existing.push_back(exports.folder + "/" + exports.name + extension);
      }
    } else if (state == "exporting") {
      exports.is_running = true;
    } else if (state == "exported") {
      std::uint64_t bytes = 9'712'384;
      for (const std::string_view extension : exports.latest.formats) {
        exports.written.push_back(
            {exports.folder + "/" + exports.name + std::string(extension), bytes});
        bytes += 2'348'801;
      }
    } else {
      exports.failure =
          "/media/clinic/stick/" + exports.name +
          ".glb: cannot be written: No space left on device; free some space or choose another "
          "folder";
    }
    return view;
  }

  [[nodiscard]] AppView failed(const ui::Texts& texts) const {
    AppView view = paused();
    scan::ScanSnapshot scan = *view.scan;
    scan.failure = "The disk is full. Free some space, then press Finish again. The scan is safe.";
    set_scan(view, std::move(scan));
    view.notices = {{1, ui::Severity::kWarning,
                     texts.fill<ui::Text::kNotSavedBecause>("No space left on device")}};
    return view;
  }

  [[nodiscard]] AppView unnamed() const {
    AppView view = paused();
    view.file.path = "/home/clinic/.local/state/flytri/unnamed/2031-05-02-104211-7.flytri";
    view.file.is_unnamed = true;
    view.file.fields = {};
    ui::KnownCase earlier;
    earlier.path = "/home/clinic/.local/state/flytri/unnamed/2031-05-02-094503-6.flytri";
    earlier.modified = "Today 09:47";
    earlier.is_unnamed = true;
    view.file.known.insert(view.file.known.begin(), earlier);
    return view;
  }

  [[nodiscard]] AppView not_saved() const {
    AppView view = scanning();
    view.file.failure =
        "Rivera-2031.flytri: no space left; free some space or choose another folder";
    return view;
  }

  [[nodiscard]] AppView damaged() const {
    AppView view = paused();
    view.file.is_read_only = true;
    ui::DamagedCase& damaged = view.file.damaged.emplace();
    damaged.copy_path = "/home/clinic/cases/Rivera-2031-rescued.flytri";
    io::CaseSurvey& survey = damaged.survey.emplace();
    survey.readable = {{{2389, 70, 1, true}, {812, 24, 0, false}}};
    for (int i = 0; i < 12; ++i) {
      survey.lost.push_back("views: upper " + std::to_string(1204 + i) + ": cannot be read");
    }
    survey.lost.emplace_back("textures: upper 1230: wrong checksum");
    return view;
  }

  /// The upper jaw was cleared; its scan is kept.
  [[nodiscard]] AppView cleared() const {
    AppView view = preview();
    view.is_scanning = false;
    view.has_kept_scan = true;
    return view;
  }

  [[nodiscard]] AppView recording() const {
    AppView view = scanning();
    view.recording.is_on = true;
    view.recording.path = view.recording.folder + "/2031-05-02-104211";
    view.recording.frames = 2520;
    view.recording.bytes = 1'204'000'000;
    view.recording.free_bytes = 41'000'000'000;
    return view;
  }

  [[nodiscard]] AppView no_sensor() const {
    AppView view = paused();
    view.source.hand.reset();
    view.source.kind = ui::SourceKind::kDevices;
    view.source.name = "Intra-oral rig 04";
    view.source.is_running = false;
    view.source.is_lost = true;
    view.source.message =
        "the light switch (GPIO chip) has not answered for 2.0 s: unplug it and plug it in again";
    return view;
  }

  [[nodiscard]] AppView with_devices(ui::DevicesState devices) const {
    AppView view = paused();
    view.source.hand.reset();
    view.source.kind = ui::SourceKind::kDevices;
    view.source.name = "Intra-oral rig 04";
    view.devices = std::move(devices);
    view.setup.has_rig = true;
    scan::ScanSnapshot scan = *view.scan;
    scan.latest_texture = jaw.flash_frame();
    set_scan(view, std::move(scan));
    return view;
  }

  /// The vertical lines are overexposed; the horizontal lines and the flash are too dark.
  [[nodiscard]] AppView with_faulty_devices(const ui::Texts& texts) const {
    AppView view = with_devices(faulty_devices(texts));
    scan::ScanSnapshot scan = *view.scan;
    scan.latest = {exposed(*scan.latest[0], 4.0), exposed(*scan.latest[1], 0.15)};
    scan.latest_texture = exposed(*scan.latest_texture, 0.2);
    set_scan(view, std::move(scan));
    view.source.message = view.devices->problems.front();
    return view;
  }

  [[nodiscard]] AppView calibrating(ui::RunningCalibration running, const ui::Texts& texts) const {
    AppView view = with_devices(running_devices(texts));
    view.calibration->why_not_used.clear();
    view.calibration->running = std::move(running);
    return view;
  }

  [[nodiscard]] AppView setting_up(ui::SetupStep step) const {
    AppView view = paused();
    view.setup.running = fake_setup(step);
    return view;
  }

  [[nodiscard]] static AppView ready() {
    AppView view = ordinary_view();
    view.stage_has_data = {};
    view.source.is_running = false;
    return view;
  }

  [[nodiscard]] static AppView without_case() {
    AppView view = ready();
    view.file = {};
    view.file.folder = "/home/clinic/cases";
    return view;
  }
};

FakeScan::FakeScan() : parts_(std::make_unique<Parts>()) {}
FakeScan::~FakeScan() = default;

const FakeReview& FakeScan::review() const { return parts_->review; }

std::optional<ui::AppView> FakeScan::view(std::string_view state, const ui::Texts& texts) const {
  const Parts& parts = *parts_;
  const std::array<std::function<AppView()>, kFakeStates.size()> makers = {
      [] { return Parts::ready(); },
      [&] { return parts.preview(); },
      [&] { return parts.scanning(); },
      [&] { return parts.too_near(); },
      [&] { return parts.tongue_gone(); },
      [&] { return parts.paused(); },
      [&] { return parts.lost(); },
      [&] { return parts.finishing(); },
      [&] { return parts.finished(texts); },
      [&] { return parts.failed(texts); },
      [&] { return parts.no_sensor(); },
      [] { return Parts::without_case(); },
      [&] { return parts.unnamed(); },
      [&] { return parts.not_saved(); },
      [&] { return parts.with_devices(running_devices(texts)); },
      [&] { return parts.with_faulty_devices(texts); },
      [&] { return parts.calibrating(waiting_calibration(texts), texts); },
      [&] { return parts.calibrating(refused_shot(texts), texts); },
      [&] { return parts.calibrating(refused_set(texts), texts); },
      [&] { return parts.calibrating(finished_calibration(texts), texts); },
      [&] { return parts.calibrating(broken_check(texts), texts); },
      [&] { return parts.lost_where_it_is_smooth(); },
      [&] { return parts.damaged(); },
      [&] { return parts.cleared(); },
      [&] { return parts.recording(); },
      [&] { return parts.bite(texts); },
      [&] { return parts.closing(texts); },
      [&] { return parts.jaws(texts); },
      [&] { return parts.jaws_refused(texts); },
      [&] { return parts.prepared(texts); },
      [&] { return parts.reviewed(texts); },
      [&] { return parts.other_side(texts); },
      [&] { return parts.two_bites(texts); },
      [&] { return parts.scan_body(); },
      [&] { return parts.preop(); },
      [&] { return parts.setting_up(ui::SetupStep::kWorking); },
      [&] { return parts.setting_up(ui::SetupStep::kAsking); },
      [&] { return parts.setting_up(ui::SetupStep::kDone); },
      [&] { return parts.setting_up(ui::SetupStep::kFailed); },
      [&] { return parts.flat(); }};
  std::optional<AppView> view;
  const auto found = std::find(kFakeStates.begin(), kFakeStates.end(), state);
  if (std::find(kExportStates.begin(), kExportStates.end(), state) != kExportStates.end()) {
    view = parts.exported(state, texts);
  } else if (found != kFakeStates.end()) {
    view = makers[static_cast<std::size_t>(found - kFakeStates.begin())]();
  }
  if (view) view->texts = texts;
  return view;
}

}  // namespace flytri::testing
