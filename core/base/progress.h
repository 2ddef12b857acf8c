/// @file  Progress of long work: the work reports here and asks whether it was canceled.
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

/// Copies share one state: the work reports, an observer shows it and may cancel. A
/// default-constructed Progress is valid and has no observer. All members are thread-safe.
///
/// Work that opens stages gives each a name and a number of steps. Work that is one step of a stage
/// advances its Progress by one step in total, and divides that step among its own parts with
/// part().
class Progress {
 public:
  struct Snapshot {
    std::string stage;      ///< name of the stage, shown to the user
    double fraction = 0.0;  ///< completed share of the stage, 0..1; never decreases within a stage
  };

  /// Called at every advance, on the thread that advances.
  using Watch = std::function<void(const Snapshot&)>;

  Progress() = default;
  /// For an observer that must see every advance. Others poll snapshot().
  explicit Progress(Watch watch) { state_->watch = std::move(watch); }

  /// Opens a stage of `total` steps and ends the previous one.
  void begin_stage(std::string name, std::size_t total = 1) const {
    const std::lock_guard lock(state_->mutex);
    state_->stage = std::move(name);
    state_->total = total;
    state_->done = 0.0;
  }
  /// @param steps  >= 0, may be a fraction
  void advance(double steps = 1.0) const {
    state_->done += steps * step_size_;
    if (state_->watch) state_->watch(snapshot());
  }

  /// The progress for a part of the work: one step of the part counts as `steps` steps here.
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
    // The shares are rounded, so their sum may slightly exceed the total.
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

/// The error that canceled work returns.
inline tl::unexpected<Error> stopped() {
  return fail(ErrorCode::kCancelled, "stopped; nothing was written");
}

}  // namespace flytri
