/// @file  A localized line as pixels to draw.
#pragma once

#include <vector>

#include "core/imaging/pattern.h"
#include "core/localization/line_trace.h"

namespace flytri::localization {

/// Every fourth sample of a trace.
[[nodiscard]] std::vector<Pixel> outline_of(const LineTrace& trace, Pattern pattern);

}  // namespace flytri::localization
