#include "app/session/source_controller.h"

#include <fmt/chrono.h>

#include <ctime>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/session/rig_devices.h"
#include "app/session/user_folders.h"
#include "core/calibration/record/calibration_history.h"

namespace flytri::session {
namespace {

/// Named after the time, not after the patient; one that does not exist yet.
std::filesystem::path new_recording_folder(const std::filesystem::path& parent) {
  const std::string name = fmt::format("{:%Y-%m-%d-%H%M%S}", fmt::localtime(std::time(nullptr)));
  std::filesystem::path folder = parent / name;
  std::error_code ignored;
  for (int number = 2; std::filesystem::exists(folder, ignored); ++number) {
    folder = parent / fmt::format("{}-{}", name, number);
  }
  return folder;
}

}  // namespace

SourceController::SourceController(SourceChoice choice, BackgroundWork& background,
                                   Notices& notices, std::function<void()> opened)
    : choice_(std::move(choice)),
      background_(background),
      notices_(notices),
      opened_(std::move(opened)) {}

void SourceController::open() {
  background_.run([this, choice = choice_, number = ++opening_, texts = notices_.texts()] {
    auto opened =
        std::make_shared<Result<Source>>(open_source(choice, background_.progress(), texts));
    return [this, opened, number] {
      if (number != opening_) return;
      if (!*opened) {
        failure_ = opened->error().message;
        return notices_.add(ui::Severity::kError, failure_);
      }
      source_ = std::move(**opened);
      failure_.clear();
      if (!source_.warning.empty()) notices_.add(ui::Severity::kWarning, source_.warning);
      opened_();
      start_capture();
      remind_of_check();
    };
  });
}

/// Of devices alone: a recording is over, and the virtual sensor does not age.
void SourceController::remind_of_check() {
  if (!choice_.is_rig() || source_.calibration == nullptr) return;
  const calibration::CalibrationHistory& history = source_.calibration->history;
  const ui::Texts& texts = notices_.texts();
  if (history.last_check() != nullptr && !history.last_check()->has_passed)
    return notices_.add(ui::Severity::kWarning, texts[ui::Text::kCalibrationFailedCheck]);
  const auto days = calibration::days_since_valid(history, std::time(nullptr));
  if (days && *days >= calibration::kCheckEvery_days)
    notices_.add(ui::Severity::kInformation, texts.fill<ui::Text::kCalibrationIsOld>(*days));
}

void SourceController::start_capture() {
  capture_.reset();
  if (lent_) return;
  router_->begin_sensor();
  begin_recording();
  source_.sensor->rest(rests_);
  capture_ = std::make_unique<device::CaptureLoop>(
      source_.sensor, [router = router_](Frame frame) { router->offer(std::move(frame)); });
}

void SourceController::replay() {
  if (choice_.name == kRecordingSource) start_capture();
}

/// A sensor that starts again counts its times from zero: that is another recording.
void SourceController::begin_recording() {
  if (source_.recorder == nullptr || records_in_.empty()) return;
  const bool is_named = std::exchange(records_in_named_folder_, false);
  source_.recorder->record_to(is_named ? records_in_ : new_recording_folder(records_in_));
  if (is_named) records_in_ = records_in_.parent_path();
}

void SourceController::record(const ui::RecordFrames& command) {
  const auto folder = typed_folder(command.folder, notices_.texts());
  if (command.is_on && !folder) {
    return notices_.add(ui::Severity::kError, folder.error().message);
  }
  records_in_ = command.is_on ? *folder : std::filesystem::path();
  records_in_named_folder_ = false;
  if (source_.recorder == nullptr) return;
  if (command.is_on) return begin_recording();
  source_.recorder->end_recording();
}

void SourceController::record_in(const std::filesystem::path& folder) {
  records_in_ = std::filesystem::absolute(folder);
  records_in_named_folder_ = true;
  begin_recording();
}

ui::RecordingState SourceController::recording_state(double now_s) {
  ui::RecordingState state;
  state.folder = recordings_folder().string();
  state.is_possible = choice_.name != kRecordingSource;
  state.is_on = !records_in_.empty();
  if (source_.recorder == nullptr) return state;
  const recording::RecorderStatus status = source_.recorder->recorder_status();
  state.path = status.folder.string();
  state.frames = status.written;
  state.bytes = status.bytes;
  state.failure = status.message;
  // Nothing is recorded any more; the reason stays until the next recording.
  if (status.has_ended) state.is_on = false;
  if (state.is_on && now_s > space_known_s_ + 1.0) {
    space_known_s_ = now_s;
    std::error_code unknown;
    const auto space = std::filesystem::space(status.folder, unknown);
    free_bytes_ = unknown ? std::nullopt : std::optional<std::uint64_t>(space.available);
  }
  state.free_bytes = free_bytes_;
  return state;
}

void SourceController::note_check(const calibration::Calibration& checked,
                                  const calibration::CalibrationCheck& check) {
  if (source_.calibration.get() != &checked) return;
  calibration::Calibration calibration = checked;
  calibration.history.checks.push_back(check);
  source_.calibration = std::make_shared<const calibration::Calibration>(std::move(calibration));
}

void SourceController::choose(SourceChoice choice) {
  capture_.reset();
  source_ = {};
  failure_.clear();
  checked_ = {};
  choice_ = std::move(choice);
  ++opening_;
}

void SourceController::lend(ui::Text why) {
  lent_ = why;
  capture_.reset();
}

void SourceController::take_back() {
  lent_.reset();
  if (source_.sensor != nullptr) start_capture();
}

void SourceController::rest(bool rests) {
  if (std::exchange(rests_, rests) != rests && source_.sensor != nullptr)
    source_.sensor->rest(rests);
}

void SourceController::stop() {
  capture_.reset();
  router_->set_scan(nullptr);
}

bool SourceController::is_running() const {
  return capture_ != nullptr && capture_->status().state == device::SensorState::kRunning;
}

void SourceController::retry() {
  if (source_.sensor == nullptr) return open();
  if (capture_ != nullptr && capture_->status().state == device::SensorState::kFailed)
    start_capture();
}

void SourceController::check_devices() {
  if (!choice_.is_rig() || checked_.is_checking) return;
  // While the devices run they report their own problems. A check would only find them in use.
  if (is_running()) {
    checked_.problems.clear();
    checked_.is_checked = true;
    return;
  }
  checked_.is_checking = true;
  background_.run([this, choice = choice_] {
    auto problems = std::make_shared<std::vector<std::string>>(check_chosen_rig(choice));
    return [this, problems] {
      checked_.problems = *problems;
      checked_.is_checked = true;
      checked_.is_checking = false;
      if (problems->empty()) retry();
    };
  });
}

bool SourceController::has_failed() const {
  if (capture_ == nullptr) return !failure_.empty();
  return capture_->status().state == device::SensorState::kFailed;
}

void SourceController::check_failed_devices() {
  if (!choice_.is_rig()) return;
  if (is_running()) checked_.is_checked = false;
  if (has_failed() && !checked_.is_checked) check_devices();
}

/// The movement is given in the sensor's frame, the aim in the model's.
void SourceController::steer(const ui::SteerHand& command) {
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

/// The hand knows the sensor's pose in the model, the scan knows it in its world. Both together
/// give T_model_world, which stays valid when tracking is lost.
void SourceController::relate_hand(const std::optional<Isometry>& T_world_sensor) {
  if (source_.hand == nullptr) return;
  if (!T_world_sensor) {
    T_model_world_.reset();
  } else if (!related_at_ || related_at_->matrix() != T_world_sensor->matrix()) {
    T_model_world_ = source_.hand->T_model_sensor() * T_world_sensor->inverse();
  }
  related_at_ = T_world_sensor;
}

void SourceController::point(const ui::PointHand& command) {
  if (source_.hand == nullptr || !T_model_world_) return;
  const Vec3 direction = T_model_world_->linear() * command.direction;
  const auto target_mm = source_.hand->pick(*T_model_world_ * command.origin_mm, direction);
  if (target_mm) source_.hand->follow_pointer({*target_mm, -direction, Vec3::Zero()});
}

void SourceController::follow_path(bool follows) {
  if (source_.hand == nullptr) return;
  if (follows) return source_.hand->follow_path();
  source_.hand->follow_pointer(source_.hand->aim());
}

void SourceController::take_away(bool is_away) {
  if (source_.hand == nullptr) return;
  if (is_away) return source_.hand->take_away();
  source_.hand->follow_path();
}

ui::SourceState SourceController::state() const {
  ui::SourceState state;
  state.kind = source_.kind;
  if (source_.sensor == nullptr) {
    state.message = failure_.empty() ? background_.progress().snapshot().stage : failure_;
    state.is_lost = !failure_.empty();
    return state;
  }
  state.name = source_.sensor->name();
  if (capture_ == nullptr) {
    if (lent_) state.message = notices_.texts()[*lent_];
    return state;
  }
  const device::SensorStatus status = capture_->status();
  state.is_running = status.state == device::SensorState::kRunning;
  state.is_lost =
      status.state == device::SensorState::kLost || status.state == device::SensorState::kFailed;
  state.has_ended = status.state == device::SensorState::kEnded;
  state.message = status.message;
  if (source_.hand != nullptr) {
    const device::HandMode mode = source_.hand->mode();
    state.hand =
        ui::SimulatedHand{mode == device::HandMode::kPath, mode == device::HandMode::kAway};
  }
  return state;
}

std::optional<ui::DevicesState> SourceController::devices_state() const {
  if (!choice_.is_rig()) return std::nullopt;
  const ui::SourceState source = state();
  ui::DevicesState devices = checked_;
  if (source_.rig)
    devices.devices =
        device_states(source_.rig->settings, source_.rig->sensor->rig_status(), notices_.texts());
  // A source that runs has no problems of an earlier check.
  if (source.is_running) devices.problems.clear();
  devices.is_checked = devices.is_checked || source.is_running;
  if (source.message.empty() || (!source.is_running && !source.is_lost)) return devices;
  std::erase(devices.problems, source.message);
  devices.problems.insert(devices.problems.begin(), source.message);
  return devices;
}

}  // namespace flytri::session
