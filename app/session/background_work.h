/// @file  Runs work that takes time on one thread, and its consequences on the caller's thread.
#pragma once

#include <functional>
#include <mutex>
#include <vector>

#include "core/base/progress.h"
#include "core/base/task_thread.h"

namespace flytri::session {

/// Used by the window's thread.
class BackgroundWork {
 public:
  /// Called by settle().
  using Settle = std::function<void()>;

  ~BackgroundWork() { stop(); }

  /// Calls `work` on the background thread, and what it returns in a later settle().
  void run(std::function<Settle()> work) {
    thread_.post([this, work = std::move(work)] {
      Settle settle = work();
      const std::lock_guard lock(mutex_);
      done_.push_back(std::move(settle));
    });
  }

  /// Settles the work that is done.
  void settle() {
    std::vector<Settle> done;
    {
      const std::lock_guard lock(mutex_);
      done.swap(done_);
    }
    for (const Settle& settle : done) settle();
  }

  /// Of all work; cancelled by cancel().
  [[nodiscard]] const Progress& progress() const { return progress_; }
  void cancel() const { progress_.cancel(); }
  /// Ends the thread. What was not settled is dropped.
  void stop() { thread_.stop(); }

 private:
  std::mutex mutex_;
  std::vector<Settle> done_;
  Progress progress_;
  TaskThread thread_;  ///< destroyed first
};

}  // namespace flytri::session
