#include "core/scan/background_refinement.h"

#include "core/base/free_memory.h"

namespace flytri::scan {

void BackgroundRefinement::run_if_more(std::size_t view_count, double growth,
                                       const std::function<std::vector<AlignedView>()>& collect) {
  if (is_running_ || view_count < static_cast<std::size_t>(options_.min_views)) return;
  if (static_cast<double>(view_count) <= growth * static_cast<double>(refined_count_)) return;
  is_running_ = true;
  refined_count_ = view_count;
  background_.post([this, views = collect(), discarded = discarded_runs_]() mutable {
    const auto refined =
        refinement::refine_jointly(views, options_.refinement, Workers(1), progress_);
    release_free_memory();
    ask_([this, done = refined.has_value(), views = std::move(views), discarded] {
      is_running_ = false;
      if (done && discarded == discarded_runs_) take_(views);
    });
  });
}

}  // namespace flytri::scan
