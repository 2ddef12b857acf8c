/// @file  The part of TrackedScan that applies edits.
#include <limits>
#include <utility>

#include "core/editing/serving_views.h"
#include "core/tracking/tracked_scan.h"

namespace flytri::tracking {

void TrackedScan::set_edits(const editing::EditFilter& edits) {
  edits_ = edits;
  std::vector<AlignedView> whole;
  whole.reserve(views_.size());
  for (const TrackedView& view : views_) whole.push_back(view.aligned);
  const Workers workers;
  const std::vector<AlignedView> serving = editing::serving_views(whole, edits_, workers);
  workers.for_each(views_.size(), [&](std::size_t i) { cut(views_[i], serving[i].view); });
  for (std::size_t i = 0; i < views_.size(); ++i) locate_extent(i);
}

/// Places what serves of the view instead of what was placed before.
void TrackedScan::cut(TrackedView& view, const std::shared_ptr<const View>& serving) const {
  const bool is_whole = serving == view.aligned.view;
  if (is_whole && !view.placed_whole) return;
  if (!view.placed_whole) view.placed_whole = std::move(view.placed);
  if (is_whole) {
    view.placed = std::move(*view.placed_whole);
    view.placed_whole.reset();
    view.part = nullptr;
  } else {
    view.placed =
        registration::prepare_view(*serving, options_.smoothing).moved(view.aligned.T_world_sensor);
    view.part = serving;
  }
  view.uncertainty_mm = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace flytri::tracking
