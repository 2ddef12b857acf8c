#include "hw/simulated/devices/live_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::simulated {
namespace {

// Allows for rounding of the clock: an exposure this near its end is over.
constexpr double kRounding_s = 1e-6;

}  // namespace

Result<void> LiveSensorOptions::validate() const {
  return OptionCheck("LiveSensorOptions")
      .nested(sensor)
      .nested(path)
      .nested(hand)
      .nested(image)
      .not_negative("texture_period_s", texture_period_s)
      .result();
}

Result<std::shared_ptr<LiveSensor>> LiveSensor::create(
    const TriangleMesh& mesh, const LiveSensorOptions& options,
    std::shared_ptr<const calibration::Calibration> calibration, device::Clock clock) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  auto simulator = ImageSimulator::create(mesh, options.sensor, options.image);
  if (!simulator) return tl::unexpected(simulator.error());
  auto path = plan_path(simulator->scene(), options.sensor, options.path);
  if (!path) return tl::unexpected(path.error());
  return std::shared_ptr<LiveSensor>(new LiveSensor(
      *std::move(simulator), *std::move(path), options, std::move(calibration), std::move(clock)));
}

LiveSensor::LiveSensor(ImageSimulator simulator, SensorPath path, LiveSensorOptions options,
                       std::shared_ptr<const calibration::Calibration> calibration,
                       device::Clock clock)
    : simulator_(std::move(simulator)),
      path_(std::move(path)),
      options_(std::move(options)),
      calibration_(std::move(calibration)),
      clock_(std::move(clock)) {}

Result<void> LiveSensor::start() {
  if (status_.state() == device::SensorState::kRunning) return {};
  hand_ = std::make_unique<Hand>(simulator_.scene(), options_.sensor, path_, options_.hand);
  slot_ = 0;
  pattern_ = Pattern::kVertical;
  texture_round_ = 0;
  taken_ = 0;
  {
    const std::lock_guard lock(mutex_);
    // Requests made before the start apply from the start.
    request_ = Request{mode_, aim_};
    T_model_sensor_.reset();
    truth_.clear();
  }
  start_s_ = clock_.now_s();
  status_.restart();
  return {};
}

void LiveSensor::stop() { status_.set(device::SensorState::kIdle); }

// A frame is available when its exposure is over.
double LiveSensor::due_s(std::int64_t slot) const {
  return static_cast<double>(slot) * options_.sensor.frame_period_s +
         0.5 * options_.sensor.exposure_s;
}

Result<std::optional<Frame>> LiveSensor::next(double timeout_s) {
  if (status_.state() != device::SensorState::kRunning)
    return fail(ErrorCode::kBadOption, "{}: start it first", name());
  const double waiting_s = due_s(slot_) - (clock_.now_s() - start_s_);
  clock_.sleep_s(std::min(waiting_s, timeout_s));
  const double now_s = clock_.now_s() - start_s_ + kRounding_s;
  if (now_s < due_s(slot_)) return std::nullopt;
  const auto latest =
      static_cast<std::int64_t>(std::floor((now_s - due_s(0)) / options_.sensor.frame_period_s));
  if (latest > slot_) {
    status_.count_dropped(latest - slot_);
    slot_ = latest;
  }
  const std::int64_t slot = slot_++;
  const double time_s = static_cast<double>(slot) * options_.sensor.frame_period_s;
  const Isometry T_model_sensor = move_hand(time_s);
  if (rests_) return std::nullopt;
  Frame frame = take(slot, time_s, T_model_sensor);
  status_.count_delivered();
  return frame;
}

void LiveSensor::apply_request() {
  std::optional<Request> request;
  {
    const std::lock_guard lock(mutex_);
    std::swap(request, request_);
  }
  if (!request) return;
  switch (request->mode) {
    case device::HandMode::kPath:
      return hand_->follow_path();
    case device::HandMode::kPointer:
      return hand_->follow_pointer(request->aim);
    case device::HandMode::kAway:
      return hand_->take_away();
  }
}

bool LiveSensor::is_texture(std::int64_t slot) const {
  if (options_.texture_period_s <= 0.0) return false;
  const double time_s = static_cast<double>(slot) * options_.sensor.frame_period_s;
  return static_cast<std::int64_t>(time_s / options_.texture_period_s) > texture_round_;
}

Isometry LiveSensor::move_hand(double time_s) {
  apply_request();
  hand_->advance(time_s + 0.5 * options_.sensor.exposure_s);
  Isometry T_model_sensor = hand_->T_model_sensor(time_s);
  const std::lock_guard lock(mutex_);
  T_model_sensor_ = T_model_sensor;
  aim_ = hand_->aim();
  return T_model_sensor;
}

Frame LiveSensor::take(std::int64_t slot, double time_s, const Isometry& T_model_sensor) {
  Frame frame;
  frame.index = FrameIndex(taken_);
  frame.time_s = time_s;
  const double half_s = 0.5 * options_.sensor.exposure_s;
  const auto stream = static_cast<std::uint64_t>(taken_++);
  if (is_texture(slot)) {
    texture_round_ = static_cast<std::int64_t>(frame.time_s / options_.texture_period_s);
    frame.kind = FrameKind::kTexture;
    frame.image = simulator_.texture_image(T_model_sensor, stream);
  } else {
    frame.kind = pattern_ == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
    const double begin_s = frame.time_s - half_s;
    const double end_s = frame.time_s + half_s;
    const SensorPath path = SensorPath::from_poses({{begin_s, hand_->T_model_sensor(begin_s)},
                                                    {frame.time_s, T_model_sensor},
                                                    {end_s, hand_->T_model_sensor(end_s)}})
                                .value();
    frame.image = simulator_.measurement_image(pattern_, path, frame.time_s, stream);
    pattern_ = other(pattern_);
  }
  const std::lock_guard lock(mutex_);
  truth_.push_back({frame.time_s, T_model_sensor});
  return frame;
}

void LiveSensor::follow_path() {
  const std::lock_guard lock(mutex_);
  mode_ = device::HandMode::kPath;
  request_ = Request{mode_, {}};
}

void LiveSensor::follow_pointer(const device::HandAim& aim) {
  const std::lock_guard lock(mutex_);
  mode_ = device::HandMode::kPointer;
  request_ = Request{mode_, aim};
}

void LiveSensor::take_away() {
  const std::lock_guard lock(mutex_);
  mode_ = device::HandMode::kAway;
  request_ = Request{mode_, {}};
}

device::HandMode LiveSensor::mode() const {
  const std::lock_guard lock(mutex_);
  return mode_;
}

device::HandAim LiveSensor::aim() const {
  const std::lock_guard lock(mutex_);
  return aim_;
}

std::optional<Vec3> LiveSensor::pick(const Vec3& origin_mm, const Vec3& direction) const {
  const auto hit = simulator_.scene().first_hit({origin_mm, direction});
  if (!hit) return std::nullopt;
  return hit->point_mm;
}

Isometry LiveSensor::T_model_sensor() const {
  const std::lock_guard lock(mutex_);
  return T_model_sensor_.value_or(path_.T_model_sensor(path_.start_s()));
}

std::vector<PathPose> LiveSensor::truth() const {
  const std::lock_guard lock(mutex_);
  return truth_;
}

}  // namespace flytri::simulated
