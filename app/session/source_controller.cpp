#include "app/session/source_controller.h"

#include <utility>
#include <vector>

#include "app/session/rig_devices.h"

namespace flytri::session {

SourceController::SourceController(SourceChoice choice, BackgroundWork& background,
                                   Notices& notices, std::function<void()> opened)
    : choice_(std::move(choice)),
      background_(background),
      notices_(notices),
      opened_(std::move(opened)) {}

void SourceController::open() {
  background_.run([this, texts = notices_.texts()] {
    auto opened =
        std::make_shared<Result<Source>>(open_source(choice_, background_.progress(), texts));
    return [this, opened] {
      if (!*opened) {
        failure_ = opened->error().message;
        return notices_.add(ui::Severity::kError, failure_);
      }
      source_ = std::move(**opened);
      failure_.clear();
      if (!source_.warning.empty()) notices_.add(ui::Severity::kWarning, source_.warning);
      opened_();
      start_capture();
    };
  });
}

void SourceController::start_capture() {
  capture_.reset();
  if (is_lent_) return;
  router_->begin_sensor();
  capture_ = std::make_unique<device::CaptureLoop>(
      source_.sensor, [router = router_](Frame frame) { router->offer(std::move(frame)); });
}

void SourceController::lend() {
  is_lent_ = true;
  capture_.reset();
}

void SourceController::take_back() {
  is_lent_ = false;
  if (source_.sensor != nullptr) start_capture();
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
  background_.run([this] {
    auto problems = std::make_shared<std::vector<std::string>>(check_chosen_rig(choice_));
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
    state.message = notices_.texts()[ui::Text::kSensorIsBeingCalibrated];
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
