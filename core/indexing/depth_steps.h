/// @file  Cuts traces where they may jump from one line to another.
#pragma once

#include <cstddef>
#include <vector>

#include "core/localization/line_trace.h"

namespace flytri::indexing {

/// A piece of a trace that shows one line.
struct TracePart {
  localization::LineTrace samples;
  bool continues = false;  ///< the part before it in the list is of the same trace
};

/// Cuts each trace where its width or its position jumps: at a depth step a trace may go on along
/// another line, that of a nearer or farther surface, if the images of both meet there.
/// @return  the parts in the order of the traces; together they have all samples
[[nodiscard]] std::vector<TracePart> cut_at_depth_steps(
    const std::vector<localization::LineTrace>& traces);

}  // namespace flytri::indexing
