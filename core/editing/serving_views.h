/// @file  Views with only the samples that the edits keep.
#pragma once

#include <span>
#include <vector>

#include "core/base/workers.h"
#include "core/editing/edits.h"
#include "core/geometry/view.h"

namespace flytri::editing {

/// Removes the samples that the edits cut. A view that loses nothing stays the same object. A cut
/// in the middle of a profile makes two profiles of it; a view may lose all.
///
/// A brush only reaches surface that faces it, so each sample needs a normal. Only views from
/// between the same two edits give it: later scanning does not change what an edit cut.
/// @return  parallel to the views, with their poses
[[nodiscard]] std::vector<AlignedView> serving_views(std::span<const AlignedView> views,
                                                     const EditFilter& edits,
                                                     const Workers& workers);

}  // namespace flytri::editing
