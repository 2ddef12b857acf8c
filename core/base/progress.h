/// @file  One copyable object that long work reports to and asks whether to stop.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "core/base/result.h"

namespace flytri {

/// Shared between the worker, who reports, and an observer, who shows and may cancel.
/// A default-constructed Progress is valid and simply unobserved. All members are thread-safe.
///
/// Work that opens stages names them and says of how many steps each is. Work that is a part of a
/// stage advances what it was given by one step in all, and gives its own parts their share by
/// part().
class Progress {
 public:
  struct Snapshot {
    std::string stage;      ///< what is being done, in the user's words
    double fraction = 0.0;  ///< done share of the stage, 0..1; never falls within a stage
  };

  /// Told at every advance, by the thread that advances.
  using Watch = std::function<void(const Snapshot&)>;

  Progress() = default;
  /// For an observer that must miss nothing; others look at the snapshot when it suits them.
  explicit Progress(Watch watch) { state_->watch = std::move(watch); }

  /// Opens a stage of `total` steps; the former stage is done.
  void begin_stage(std::string name, std::size_t total = 1) const {
    const std::lock_guard lock(state_->mutex);
    state_->stage = std::move(name);
    state_->total = total;
    state_->done = 0.0;
  }
  /// @param steps  >= 0, also fractions of one
  void advance(double steps = 1.0) const {
    state_->done += steps * step_size_;
    if (state_->watch) state_->watch(snapshot());
  }

  /// The same progress for a part of the work: one step of the part is `steps` of this one.
  /// @param steps  >= 0
  [[nodiscard]] Progress part(double steps) const {
    Progress part = *this;
    part.step_size_ *= steps;
    return part;
  }

  void cancel() const { state_->cancelled = true; }
  [[nodiscard]] bool cancelled() const { return state_->cancelled; }

  [[nodiscard]] Snapshot snapshot() const {
    const std::lock_guard lock(state_->mutex);
    const double total = static_cast<double>(state_->total);
    // Shares are rounded, so that their sum may be a little above the total.
    return {state_->stage, total > 0 ? std::min(state_->done / total, 1.0) : 0.0};
  }

 private:
  struct State {
    Watch watch;
    std::mutex mutex;
    std::string stage;
    std::size_t total = 0;
    std::atomic<double> done{0.0};
    std::atomic<bool> cancelled{false};
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
  double step_size_ = 1.0;  ///< of this part, in steps of the stage
};

/// What work that was cancelled returns.
inline tl::unexpected<Error> stopped() {
  return fail(ErrorCode::kCancelled, "stopped; nothing was written");
}

}  // namespace flytri
