#include "app/session/session.h"

#include <utility>

#include "app/session/export_files.h"
#include "app/session/settings_file.h"
#include "app/session/user_folders.h"
#include "hw/device/clock.h"

namespace flytri {
namespace {

/// Notices that the window may still want to show.
constexpr std::size_t kNotices = 20;

std::filesystem::path settings_path() { return config_folder() / "settings.json"; }

}  // namespace

Session::Session(SessionOptions options)
    : options_(std::move(options)), settings_(read_settings(settings_path())) {
  options_.scan.now_s = machine_clock().now_s;
  exports_.folder = documents_folder().string();
  exports_.name = "jaw";
  open_chosen_source();
}

Session::~Session() {
  beside_.cancel();
  capture_.reset();
  router_->set_scan(nullptr);
  beside_thread_.stop();
}

double Session::now_s() const { return options_.scan.now_s(); }

std::shared_ptr<LiveScan> Session::scan() const { return scans_[stage_]; }

void Session::carry_out(const ui::Command& command) {
  std::visit([this](const auto& given) { carry_out_(given); }, command);
}

void Session::do_beside(std::function<std::function<void()>()> work) {
  beside_thread_.post([this, work = std::move(work)] {
    std::function<void()> settle = work();
    const std::lock_guard lock(done_mutex_);
    done_.push_back(std::move(settle));
  });
}

void Session::open_chosen_source() {
  do_beside([this] {
    auto opened = std::make_shared<Result<Source>>(open_source(options_.source, beside_));
    return [this, opened] {
      if (*opened) return use_source(std::move(**opened));
      source_failure_ = opened->error().message;
      notice(ui::Severity::kError, source_failure_);
    };
  });
}

void Session::use_source(Source source) {
  source_ = std::move(source);
  show_stage();
  router_->begin_sensor();
  capture_ = std::make_unique<CaptureLoop>(
      source_.sensor, [router = router_](Frame frame) { router->offer(std::move(frame)); });
}

Result<std::shared_ptr<LiveScan>> Session::make_scan() const {
  Result<std::unique_ptr<LiveScan>> scan = LiveScan::create(source_.calibration, options_.scan);
  if (!scan) return tl::unexpected(scan.error());
  return std::shared_ptr<LiveScan>(std::move(*scan));
}

/// Makes the stage's scan, if it has none yet, and sends the frames there.
void Session::show_stage() {
  if (source_.sensor == nullptr) return;
  if (scans_[stage_] == nullptr) {
    Result<std::shared_ptr<LiveScan>> scan = make_scan();
    if (!scan) return notice(ui::Severity::kError, scan.error().message);
    scans_[stage_] = std::move(*scan);
  }
  if (is_started_) scans_[stage_]->start();
  router_->set_scan(scans_[stage_]);
}

void Session::notice(ui::Severity severity, std::string text) {
  notices_.push_back({++notice_number_, severity, std::move(text)});
  if (notices_.size() > kNotices) notices_.erase(notices_.begin());
}

void Session::carry_out_(const ui::StartScan&) {
  is_started_ = true;
  if (scan()) scan()->start();
}

void Session::carry_out_(const ui::PauseScan&) {
  is_started_ = false;
  if (scan()) scan()->pause();
}

void Session::carry_out_(const ui::Undo&) {
  if (scan()) scan()->undo();
}

void Session::carry_out_(const ui::Redo&) {
  if (scan()) scan()->redo();
}

void Session::carry_out_(const ui::EditSurface& command) {
  if (scan()) scan()->edit(command.kind, command.dabs);
}

void Session::carry_out_(const ui::AddMeasurement& command) {
  measurements_[stage_].push_back(command.measurement);
}

void Session::carry_out_(const ui::RemoveMeasurement& command) {
  auto& measurements = measurements_[stage_];
  if (command.index >= measurements.size()) return;
  measurements.erase(measurements.begin() + static_cast<std::ptrdiff_t>(command.index));
}

void Session::carry_out_(const ui::Finish&) {
  is_started_ = false;
  if (scan()) scan()->finish();
}

void Session::carry_out_(const ui::CancelFinish&) {
  if (scan()) scan()->cancel_finish();
}

void Session::carry_out_(const ui::ResumeScan&) { carry_out_(ui::StartScan{}); }

void Session::carry_out_(const ui::ChooseReentry& command) {
  if (scan()) scan()->choose_reentry(command.index);
}

void Session::carry_out_(const ui::SelectStage& command) {
  if (scan()) scan()->pause();
  is_started_ = false;
  stage_ = static_cast<std::size_t>(command.stage);
  show_stage();
}

void Session::carry_out_(const ui::Export& command) {
  if (scan() == nullptr || exports_.is_running) return;
  exports_.is_running = true;
  exports_.failure.clear();
  do_beside([this, command, shown = scan()->snapshot()] {
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

void Session::carry_out_(const ui::NewCase&) {}
void Session::carry_out_(const ui::OpenCase&) {}
void Session::carry_out_(const ui::SetCaseFields&) {}

/// The window's movement is in the sensor's frame, the hand's aim in the model's.
void Session::carry_out_(const ui::SteerHand& command) {
  if (source_.hand == nullptr) return;
  const Isometry T_model_sensor = source_.hand->T_model_sensor();
  HandAim aim = source_.hand->aim();
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
void Session::carry_out_(const ui::PointHand& command) {
  if (source_.hand == nullptr || scan() == nullptr) return;
  const std::optional<Isometry> T_world_sensor = scan()->snapshot()->T_world_sensor;
  if (!T_world_sensor) return;
  const Isometry T_model_world = source_.hand->T_model_sensor() * T_world_sensor->inverse();
  const Vec3 direction = T_model_world.linear() * command.direction;
  const auto target_mm = source_.hand->pick(T_model_world * command.origin_mm, direction);
  if (target_mm) source_.hand->follow_pointer({*target_mm, -direction, Vec3::Zero()});
}

void Session::carry_out_(const ui::FollowPath& command) {
  if (source_.hand == nullptr) return;
  if (command.follows) return source_.hand->follow_path();
  source_.hand->follow_pointer(source_.hand->aim());
}

void Session::carry_out_(const ui::TakeSensorAway& command) {
  if (source_.hand == nullptr) return;
  if (command.is_away) return source_.hand->take_away();
  source_.hand->follow_path();
}

void Session::carry_out_(const ui::ChangeSettings& command) {
  settings_ = command.settings;
  if (auto written = write_settings(settings_path(), settings_); !written) {
    notice(ui::Severity::kWarning, written.error().message);
  }
}

void Session::carry_out_(const ui::Tell& command) {
  notice(ui::Severity::kWarning, "unknown words: " + command.words);
}

ui::SourceState Session::source_state() const {
  ui::SourceState state;
  state.kind = source_.kind;
  if (source_.sensor == nullptr) {
    state.message = source_failure_.empty() ? beside_.snapshot().stage : source_failure_;
    state.is_lost = !source_failure_.empty();
    return state;
  }
  state.name = source_.sensor->name();
  const SensorStatus status = capture_->status();
  state.is_running = status.state == SensorState::kRunning;
  state.is_lost = status.state == SensorState::kLost || status.state == SensorState::kFailed;
  state.message = status.message;
  if (source_.hand != nullptr) {
    const HandMode mode = source_.hand->mode();
    state.hand = ui::SimulatedHand{mode == HandMode::kPath, mode == HandMode::kAway};
  }
  return state;
}

ui::ExportState Session::export_state(const ScanSnapshot* shown) const {
  ui::ExportState state = exports_;
  for (const ui::ExportFormat format : ui::kExportFormats) {
    if (shown == nullptr) break;
    state.estimated_bytes[static_cast<std::size_t>(format)] = estimated_bytes(*shown, format);
  }
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
  view.stage = static_cast<ScanStage>(stage_);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    view.stage_has_data[i] = scans_[i] != nullptr && !scans_[i]->snapshot()->model.empty();
  }
  view.source = source_state();
  view.exports = export_state(view.scan.get());
  view.measurements = measurements_[stage_];
  view.settings = settings_;
  if (view.scan && view.scan->failure != noticed_failure_) {
    noticed_failure_ = view.scan->failure;
    if (!noticed_failure_.empty()) notice(ui::Severity::kError, noticed_failure_);
  }
  view.notices = notices_;
  return view;
}

}  // namespace flytri
