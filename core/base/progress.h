/// @file  One copyable object that long work reports to and asks whether to stop.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

namespace flytri {

/// Shared between the worker, who reports, and an observer, who shows and may cancel.
/// A default-constructed Progress is valid and simply unobserved. All members are thread-safe.
class Progress {
 public:
  struct Snapshot {
    std::string stage;      ///< what is being done, in the user's words
    double fraction = 0.0;  ///< done share of the stage, 0..1
  };

  /// Opens a stage of `total` steps; the former stage is done.
  void begin_stage(std::string name, std::size_t total) const {
    const std::lock_guard lock(state_->mutex);
    state_->stage = std::move(name);
    state_->total = total;
    state_->done = 0;
  }
  void advance(std::size_t steps = 1) const { state_->done += steps; }

  void cancel() const { state_->cancelled = true; }
  [[nodiscard]] bool cancelled() const { return state_->cancelled; }

  [[nodiscard]] Snapshot snapshot() const {
    const std::lock_guard lock(state_->mutex);
    const double total = static_cast<double>(state_->total);
    return {state_->stage, total > 0 ? static_cast<double>(state_->done) / total : 0.0};
  }

 private:
  struct State {
    std::mutex mutex;
    std::string stage;
    std::size_t total = 0;
    std::atomic<std::size_t> done{0};
    std::atomic<bool> cancelled{false};
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace flytri
