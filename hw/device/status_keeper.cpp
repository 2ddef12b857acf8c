#include "hw/device/status_keeper.h"

#include <utility>

namespace flytri::device {

std::string_view to_string(SensorState state) {
  switch (state) {
    case SensorState::kIdle:
      return "idle";
    case SensorState::kRunning:
      return "running";
    case SensorState::kLost:
      return "lost";
    case SensorState::kEnded:
      return "ended";
    case SensorState::kFailed:
      break;
  }
  return "failed";
}

void StatusKeeper::restart() {
  const std::lock_guard lock(mutex_);
  status_ = {SensorState::kRunning, {}, 0, 0};
}

void StatusKeeper::set(SensorState state, std::string message) {
  const std::lock_guard lock(mutex_);
  status_.state = state;
  status_.message = std::move(message);
}

void StatusKeeper::count_delivered() {
  const std::lock_guard lock(mutex_);
  ++status_.delivered;
}

void StatusKeeper::count_dropped(std::int64_t frames) {
  const std::lock_guard lock(mutex_);
  status_.dropped += frames;
}

SensorStatus StatusKeeper::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

SensorState StatusKeeper::state() const {
  const std::lock_guard lock(mutex_);
  return status_.state;
}

}  // namespace flytri::device
