/// @file  Optimizes all poses of a growing scan together, in the background.
#pragma once

#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/task_thread.h"
#include "core/refinement/refine.h"

namespace flytri::scan {

/// Used by the thread that owns the scan; cancel() may be called from any thread.
class BackgroundRefinement {
 public:
  struct Options {
    refinement::JointRefineOptions refinement;
    double growth = 1.3;  ///< > 1, growth of the view count since the last run began
    int min_views = 60;   ///< >= 2, no run with fewer views
  };
  /// Lets the owner's thread call a function.
  using Ask = std::function<void(std::function<void()>)>;
  /// Called on the owner's thread with the views and their new poses.
  using Take = std::function<void(const std::vector<AlignedView>&)>;

  /// @param background  must outlive this
  BackgroundRefinement(const Options& options, TaskThread& background, Ask ask, Take take)
      : options_(options), background_(background), ask_(std::move(ask)), take_(std::move(take)) {}

  /// Begins a run if none is running and the scan has grown enough.
  /// @param view_count  views of the scan
  /// @param collect     returns these views; called only if a run begins
  void run_if_grown(std::size_t view_count,
                    const std::function<std::vector<AlignedView>()>& collect) {
    run_if_more(view_count, options_.growth, collect);
  }
  /// Begins a run if the scan has grown at all: for a scan that is paused.
  void run_if_new(std::size_t view_count,
                  const std::function<std::vector<AlignedView>()>& collect) {
    run_if_more(view_count, 1.0, collect);
  }
  [[nodiscard]] bool is_running() const { return is_running_; }
  /// The poses of a run that is not done are no longer wanted: the scan got better ones meanwhile.
  void discard_run() { ++discarded_runs_; }
  /// Cancels the present run and all later ones.
  void cancel() const { progress_.cancel(); }

 private:
  void run_if_more(std::size_t view_count, double growth,
                   const std::function<std::vector<AlignedView>()>& collect);

  const Options options_;
  TaskThread& background_;
  const Ask ask_;
  const Take take_;
  Progress progress_;
  std::size_t refined_count_ = 0;  ///< views when the last run began
  int discarded_runs_ = 0;
  bool is_running_ = false;
};

}  // namespace flytri::scan
