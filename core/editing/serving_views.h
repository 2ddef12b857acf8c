/// @file  Views with only the samples that the edits keep.
#pragma once

#include <span>
#include <vector>

#include "core/base/workers.h"
#include "core/editing/edits.h"
#include "core/geometry/view.h"

namespace flytri::editing {

/// What of these views serves: poses, colors and the model must ask for no more. A view of which
/// all is kept is the same object; of another a copy with the samples that are kept. A profile that
/// an edit interrupts is two profiles; a view may be left without any.
///
/// A brush reaches only what faces it, so a sample needs a normal. It is that of the profiles
/// around which were seen between the same two edits: what was seen before an edit is then cut in
/// the same way whatever is scanned later.
/// @return  parallel to the views, with their poses
[[nodiscard]] std::vector<AlignedView> serving_views(std::span<const AlignedView> views,
                                                     const EditFilter& edits,
                                                     const Workers& workers);

}  // namespace flytri::editing
