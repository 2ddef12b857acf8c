/// @file  A sensor that follows a script of the test.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "hw/device/sensor.h"
#include "hw/device/status_keeper.h"

namespace flytri::testing {

/// Each call of next() runs the next step of the script and returns its result. After the last step
/// the state is kEnded.
class ScriptedSensor : public device::Sensor {
 public:
  using Step = std::function<Result<std::optional<Frame>>(device::StatusKeeper&)>;

  explicit ScriptedSensor(std::deque<Step> script) : script_(std::move(script)) {}

  Result<void> start() override {
    status_.restart();
    return {};
  }
  void stop() override { status_.set(device::SensorState::kIdle); }
  Result<std::optional<Frame>> next(double /*timeout_s*/) override {
    if (script_.empty()) {
      status_.set(device::SensorState::kEnded);
      return std::nullopt;
    }
    const Step step = std::move(script_.front());
    script_.pop_front();
    return step(status_);
  }
  [[nodiscard]] device::SensorStatus status() const override { return status_.status(); }
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return nullptr;
  }
  [[nodiscard]] std::string name() const override { return "script"; }

  /// A grey frame with all pixels at `level`.
  static Step frame(int index, double time_s, std::uint8_t level = 0) {
    return [=](device::StatusKeeper& status) -> Result<std::optional<Frame>> {
      status.count_delivered();
      const FrameKind kind = index % 2 == 0 ? FrameKind::kVertical : FrameKind::kHorizontal;
      return Frame{FrameIndex(index), kind, time_s, cv::Mat(6, 8, CV_8UC1, cv::Scalar(level))};
    };
  }
  /// Returns no frame and sets this state.
  static Step nothing(device::SensorState state) {
    return [=](device::StatusKeeper& status) -> Result<std::optional<Frame>> {
      status.set(state);
      return std::nullopt;
    };
  }
  static Step failure(const std::string& message) {
    return [=](device::StatusKeeper& status) -> Result<std::optional<Frame>> {
      status.set(device::SensorState::kFailed, message);
      return fail(ErrorCode::kNotFound, "{}", message);
    };
  }

 private:
  std::deque<Step> script_;
  device::StatusKeeper status_;
};

}  // namespace flytri::testing
