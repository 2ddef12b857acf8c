/// @file  Optimizes all poses of a growing scan together, beside it.
#pragma once

#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/task_thread.h"
#include "core/refinement/refine.h"

namespace flytri::scan {

/// Of the thread that owns the scan, but for cancel().
class BackgroundRefinement {
 public:
  struct Options {
    refinement::JointRefineOptions refinement;
    double growth = 1.3;  ///< > 1, of the views since the last one began
    int min_views = 60;   ///< >= 2
  };
  /// Has the owner's thread do something.
  using Ask = std::function<void(std::function<void()>)>;
  /// Gets the views with their new poses, on the owner's thread.
  using Take = std::function<void(const std::vector<AlignedView>&)>;

  /// @param background  must outlive this
  BackgroundRefinement(const Options& options, TaskThread& background, Ask ask, Take take)
      : options_(options), background_(background), ask_(std::move(ask)), take_(std::move(take)) {}

  /// Begins where none runs and the scan has grown enough.
  /// @param view_count  of the scan
  /// @param collect     called for its views only then
  void run_if_grown(std::size_t view_count,
                    const std::function<std::vector<AlignedView>()>& collect) {
    run_if_more(view_count, options_.growth, collect);
  }
  /// The same wherever the scan has grown at all: the hand rests.
  void run_if_new(std::size_t view_count,
                  const std::function<std::vector<AlignedView>()>& collect) {
    run_if_more(view_count, 1.0, collect);
  }
  [[nodiscard]] bool is_running() const { return is_running_; }
  /// Ends the one that runs, and all that would follow. From any thread.
  void cancel() const { progress_.cancel(); }

 private:
  void run_if_more(std::size_t view_count, double growth,
                   const std::function<std::vector<AlignedView>()>& collect);

  const Options options_;
  TaskThread& background_;
  const Ask ask_;
  const Take take_;
  Progress progress_;
  std::size_t refined_count_ = 0;  ///< views when the last one began
  bool is_running_ = false;
};

}  // namespace flytri::scan
