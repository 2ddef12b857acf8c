#include "app/session/session.h"

#include <fmt/chrono.h>

#include <ctime>
#include <utility>

#include "app/session/calibration_files.h"
#include "app/session/export_files.h"
#include "app/session/settings_file.h"
#include "app/session/user_folders.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/files/file_bytes.h"
#include "hw/device/clock.h"

namespace flytri::session {
namespace {

/// Notices that the window may still want to show.
constexpr std::size_t kNotices = 20;

std::filesystem::path settings_path() { return config_folder() / "settings.json"; }
std::filesystem::path cases_folder() { return data_folder() / "cases"; }

}  // namespace

Session::Session(SessionOptions options)
    : options_(std::move(options)), settings_(read_settings(settings_path())) {
  options_.scan.now_s = device::machine_clock().now_s;
  exports_.folder = documents_folder().string();
  exports_.name = "jaw";
  calibration_folder_ = propose_calibration_folder(data_folder() / "calibrations");
  open_chosen_source();
  list_cases();
}

Session::~Session() {
  background_.cancel();
  desk_.reset();
  capture_.reset();
  router_->set_scan(nullptr);
  background_thread_.stop();
}

double Session::now_s() const { return options_.scan.now_s(); }

std::shared_ptr<scan::LiveScan> Session::scan() const { return scans_[stage_]; }

void Session::carry_out(const ui::Command& command) {
  std::visit([this](const auto& given) { handle(given); }, command);
}

void Session::do_in_background(std::function<std::function<void()>()> work) {
  background_thread_.post([this, work = std::move(work)] {
    std::function<void()> settle = work();
    const std::lock_guard lock(done_mutex_);
    done_.push_back(std::move(settle));
  });
}

void Session::open_chosen_source() {
  do_in_background([this] {
    auto opened = std::make_shared<Result<Source>>(open_source(options_.source, background_));
    return [this, opened] {
      if (*opened) return use_source(std::move(**opened));
      source_failure_ = opened->error().message;
      notice(ui::Severity::kError, source_failure_);
    };
  });
}

void Session::use_source(Source source) {
  source_ = std::move(source);
  source_failure_.clear();
  if (case_ != nullptr) warn_of_other_calibration();
  show_stage();
  start_capture();
}

void Session::start_capture() {
  capture_.reset();
  if (desk_ != nullptr || is_desk_closing_) return;
  router_->begin_sensor();
  capture_ = std::make_unique<device::CaptureLoop>(
      source_.sensor, [router = router_](Frame frame) { router->offer(std::move(frame)); });
}

/// Makes the stage's scan, if it has none yet, and sends the frames there. What a case holds of it
/// is read beside.
void Session::show_stage() {
  if (source_.sensor == nullptr || is_loading_[stage_]) return;
  if (scans_[stage_] != nullptr) {
    if (is_started_) scans_[stage_]->start();
    return router_->set_scan(scans_[stage_]);
  }
  router_->set_scan(nullptr);
  if (case_ == nullptr) return use_stage(stage_, {});
  is_loading_[stage_] = true;
  do_in_background([this, stage = stage_, store = case_] {
    auto opened = std::make_shared<Result<OpenedStage>>(store->load(io::kScanStages[stage]));
    return [this, stage, store, opened] {
      is_loading_[stage] = false;
      if (store != case_) return;
      if (!*opened) return notice(ui::Severity::kError, opened->error().message);
      use_stage(stage, **opened);
    };
  });
}

void Session::use_stage(std::size_t stage, const OpenedStage& opened) {
  scan::LiveScanOptions options = options_.scan;
  if (case_ != nullptr && !case_->is_read_only()) {
    options.journal = case_->journal(io::kScanStages[stage]);
  }
  Result<std::unique_ptr<scan::LiveScan>> scan =
      scan::LiveScan::create(source_.calibration, options, opened.scan);
  if (!scan) return notice(ui::Severity::kError, scan.error().message);
  router_->go_on_after(opened.last_frame, opened.last_time_s);
  for (const std::string& line : opened.damage) notice(ui::Severity::kWarning, line);
  scans_[stage] = std::move(*scan);
  measurements_[stage] = opened.measurements;
  if (stage == stage_) show_stage();
}

void Session::notice(ui::Severity severity, std::string text) {
  notices_.push_back({++notice_number_, severity, std::move(text)});
  if (notices_.size() > kNotices) notices_.erase(notices_.begin());
}

void Session::handle(const ui::StartScan&) {
  is_started_ = true;
  if (scan()) scan()->start();
}

void Session::handle(const ui::PauseScan&) {
  is_started_ = false;
  if (scan()) scan()->pause();
}

void Session::handle(const ui::Undo&) {
  if (scan()) scan()->undo();
}

void Session::handle(const ui::Redo&) {
  if (scan()) scan()->redo();
}

void Session::handle(const ui::EditSurface& command) {
  if (scan()) scan()->edit(command.kind, command.dabs);
}

void Session::handle(const ui::AddMeasurement& command) {
  io::Measurement added = command.measurement;
  if (case_ != nullptr) {
    const auto id = case_->add_measurement(io::kScanStages[stage_], added);
    if (!id) return notice(ui::Severity::kError, id.error().message);
    added.id = *id;
  }
  measurements_[stage_].push_back(added);
}

void Session::handle(const ui::RemoveMeasurement& command) {
  auto& measurements = measurements_[stage_];
  if (command.index >= measurements.size()) return;
  const auto removed = measurements.begin() + static_cast<std::ptrdiff_t>(command.index);
  if (case_ != nullptr) {
    const auto done = case_->remove_measurement(removed->id);
    if (!done) return notice(ui::Severity::kError, done.error().message);
  }
  measurements.erase(removed);
}

void Session::handle(const ui::Finish&) {
  is_started_ = false;
  if (scan()) scan()->finish();
}

void Session::handle(const ui::CancelFinish&) {
  if (scan()) scan()->cancel_finish();
}

void Session::handle(const ui::ResumeScan&) { handle(ui::StartScan{}); }

void Session::handle(const ui::ChooseReentry& command) {
  if (scan()) scan()->choose_reentry(command.index);
}

void Session::handle(const ui::SelectStage& command) {
  if (scan()) scan()->pause();
  is_started_ = false;
  stage_ = static_cast<std::size_t>(command.stage);
  show_stage();
}

void Session::handle(const ui::Export& command) {
  if (scan() == nullptr || exports_.is_running) return;
  exports_.is_running = true;
  exports_.failure.clear();
  do_in_background([this, command, shown = scan()->snapshot()] {
    auto done = std::make_shared<Result<std::vector<ui::ExportedFile>>>(export_files(
        *shown, std::filesystem::path(command.folder) / command.name, command.formats));
    return [this, done] {
      exports_.is_running = false;
      if (*done) {
        exports_.written = **done;
        notice(ui::Severity::kInformation, "Exported to " + exports_.written.front().path);
      } else {
        exports_.failure = done->error().message;
        notice(ui::Severity::kError, exports_.failure);
      }
    };
  });
}

void Session::forget_scans() {
  router_->set_scan(nullptr);
  scans_ = {};
  measurements_ = {};
  is_loading_ = {};
}

/// What was scanned without a case goes into a new one; what belongs to another case stays there.
void Session::handle(const ui::NewCase& command) {
  if (source_.calibration == nullptr) {
    case_state_.message = "a case holds its sensor's calibration: wait until the sensor is ready";
    return;
  }
  io::CaseFields fields = command.fields;
  fields.created = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  const std::filesystem::path path = command.path;
  if (auto made = io::create_folder(path.parent_path()); !made) {
    case_state_.message = made.error().message;
    return;
  }
  auto file = io::CaseFile::create(path, {command.passphrase, false}, fields);
  if (!file) {
    case_state_.message = file.error().message;
    return;
  }
  if (case_ != nullptr) forget_scans();
  auto store = std::make_shared<CaseStore>(std::move(*file));
  if (auto kept = store->write_calibration(*source_.calibration); !kept) {
    return notice(ui::Severity::kError, kept.error().message);
  }
  for (std::size_t stage = 0; stage < scans_.size(); ++stage) {
    if (scans_[stage] != nullptr) scans_[stage]->keep_in(store->journal(io::kScanStages[stage]));
    for (io::Measurement& measurement : measurements_[stage]) {
      measurement.id = store->add_measurement(io::kScanStages[stage], measurement).value_or(0);
    }
  }
  case_state_.is_encrypted = !command.passphrase.empty();
  use_case(std::move(store));
}

void Session::handle(const ui::OpenCase& command) {
  do_in_background([this, command] {
    auto file = std::make_shared<Result<io::CaseFile>>(
        io::CaseFile::open(command.path, {command.passphrase, false}));
    return [this, command, file] {
      if (!*file) {
        case_state_.message = file->error().message;
        case_state_.passphrase_is_asked = file->error().code == ErrorCode::kInconsistent;
        case_state_.path_asked = command.path;
        return;
      }
      forget_scans();
      case_state_.is_encrypted = !command.passphrase.empty();
      use_case(std::make_shared<CaseStore>(std::move(**file)));
      warn_of_other_calibration();
    };
  });
}

void Session::use_case(std::shared_ptr<CaseStore> store) {
  case_ = std::move(store);
  case_state_.message.clear();
  case_state_.passphrase_is_asked = false;
  case_state_.fields = case_->fields().value_or(io::CaseFields{});
  for (const std::string& line : case_->damage()) notice(ui::Severity::kWarning, line);
  if (case_->is_read_only()) case_state_.message = "opened read-only: nothing more is kept in it";
  if (scans_[stage_] == nullptr) {
    is_started_ = false;
    show_stage();
  }
  list_cases();
}

/// Its views are as exact as they were, but its texture frames suit the other camera.
void Session::warn_of_other_calibration() {
  if (source_.calibration == nullptr) return;
  const auto kept = case_->calibration();
  if (!kept || !*kept || io::to_json(**kept) == io::to_json(*source_.calibration)) return;
  notice(ui::Severity::kWarning,
         "This case was scanned with another calibration. What is scanned now is measured with the "
         "sensor's own; for the texture of what was there, use flytri reconstruct " +
             case_->path());
}

void Session::handle(const ui::SetCaseFields& command) {
  if (case_ == nullptr) return;
  io::CaseFields fields = command.fields;
  fields.created = case_->fields().value_or(io::CaseFields{}).created;
  if (auto written = case_->write_fields(fields); !written) {
    return notice(ui::Severity::kError, written.error().message);
  }
  case_state_.fields = command.fields;
}

void Session::list_cases() {
  do_in_background([this] {
    auto known = std::make_shared<std::vector<ui::KnownCase>>(known_cases(cases_folder()));
    return [this, known] { case_state_.known = std::move(*known); };
  });
}

ui::CaseState Session::case_state() const {
  ui::CaseState state = case_state_;
  state.folder = cases_folder().string();
  if (case_ == nullptr) return state;
  state.path = case_->path();
  state.is_read_only = case_->is_read_only();
  state.is_saved = case_->failure().empty();
  return state;
}

/// The window's movement is in the sensor's frame, the hand's aim in the model's.
void Session::handle(const ui::SteerHand& command) {
  if (source_.hand == nullptr) return;
  const Isometry T_model_sensor = source_.hand->T_model_sensor();
  device::HandAim aim = source_.hand->aim();
  aim.target_mm += T_model_sensor.linear() * command.move_mm;
  const double angle_rad = command.turn_rad.norm();
  if (angle_rad > 0.0) {
    const Vec3 axis = T_model_sensor.linear() * (command.turn_rad / angle_rad);
    const Eigen::AngleAxisd turn(angle_rad, axis);
    aim.towards_sensor = turn * aim.towards_sensor;
    aim.along = turn * T_model_sensor.linear().col(0);
  }
  source_.hand->follow_pointer(aim);
}

/// Where the scan is in the model frame follows from where both say the sensor is now.
void Session::handle(const ui::PointHand& command) {
  if (source_.hand == nullptr || scan() == nullptr) return;
  const std::optional<Isometry> T_world_sensor = scan()->snapshot()->T_world_sensor;
  if (!T_world_sensor) return;
  const Isometry T_model_world = source_.hand->T_model_sensor() * T_world_sensor->inverse();
  const Vec3 direction = T_model_world.linear() * command.direction;
  const auto target_mm = source_.hand->pick(T_model_world * command.origin_mm, direction);
  if (target_mm) source_.hand->follow_pointer({*target_mm, -direction, Vec3::Zero()});
}

void Session::handle(const ui::FollowPath& command) {
  if (source_.hand == nullptr) return;
  if (command.follows) return source_.hand->follow_path();
  source_.hand->follow_pointer(source_.hand->aim());
}

void Session::handle(const ui::TakeSensorAway& command) {
  if (source_.hand == nullptr) return;
  if (command.is_away) return source_.hand->take_away();
  source_.hand->follow_path();
}

void Session::handle(const ui::ChangeSettings& command) {
  settings_ = command.settings;
  if (auto written = write_settings(settings_path(), settings_); !written) {
    notice(ui::Severity::kWarning, written.error().message);
  }
}

void Session::handle(const ui::Tell& command) {
  notice(ui::Severity::kWarning, "unknown words: " + command.words);
}

ui::SourceState Session::source_state() const {
  ui::SourceState state;
  state.kind = source_.kind;
  if (source_.sensor == nullptr) {
    state.message = source_failure_.empty() ? background_.snapshot().stage : source_failure_;
    state.is_lost = !source_failure_.empty();
    return state;
  }
  state.name = source_.sensor->name();
  if (capture_ == nullptr) {
    state.message = "The sensor is being calibrated";
    return state;
  }
  const device::SensorStatus status = capture_->status();
  state.is_running = status.state == device::SensorState::kRunning;
  state.is_lost =
      status.state == device::SensorState::kLost || status.state == device::SensorState::kFailed;
  state.message = status.message;
  if (source_.hand != nullptr) {
    const device::HandMode mode = source_.hand->mode();
    state.hand =
        ui::SimulatedHand{mode == device::HandMode::kPath, mode == device::HandMode::kAway};
  }
  return state;
}

ui::ExportState Session::export_state(const scan::ScanSnapshot* shown) const {
  ui::ExportState state = exports_;
  if (shown != nullptr) state.estimated_bytes = estimated_bytes(*shown);
  return state;
}

ui::AppView Session::view() {
  std::vector<std::function<void()>> done;
  {
    const std::lock_guard lock(done_mutex_);
    done.swap(done_);
  }
  for (const auto& settle : done) settle();
  ui::AppView view;
  view.now_s = now_s();
  if (scan()) view.scan = scan()->snapshot();
  view.is_scanning = is_started_;
  if (source_.calibration) view.volume_mm = source_.calibration->volume.size_mm;
  view.stage = static_cast<io::ScanStage>(stage_);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    view.stage_has_data[i] = scans_[i] != nullptr && !scans_[i]->snapshot()->model.empty();
  }
  view.source = source_state();
  view.devices = devices_state(view.source);
  view.calibration = calibration_state();
  view.exports = export_state(view.scan.get());
  view.file = case_state();
  view.measurements = measurements_[stage_];
  view.settings = settings_;
  if (view.scan && view.scan->failure != noticed_failure_) {
    noticed_failure_ = view.scan->failure;
    if (!noticed_failure_.empty()) notice(ui::Severity::kError, noticed_failure_);
  }
  if (case_ != nullptr && case_->failure() != noticed_case_failure_) {
    noticed_case_failure_ = case_->failure();
    notice(ui::Severity::kError, "Not kept: " + noticed_case_failure_);
  }
  view.notices = notices_;
  return view;
}

}  // namespace flytri::session
