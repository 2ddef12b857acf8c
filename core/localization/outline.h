/// @file  A localized line as a picture shows it.
#pragma once

#include <vector>

#include "core/imaging/pattern.h"
#include "core/localization/line_trace.h"

namespace flytri::localization {

/// Every few samples of a trace.
[[nodiscard]] std::vector<Pixel> outline_of(const LineTrace& trace, Pattern pattern);

}  // namespace flytri::localization
