/// @file  What system libraries tell as text, or not at all.
#pragma once

#include <string>

namespace flytri::device {

/// @param text  may be null: nothing is told
[[nodiscard]] inline std::string c_text(const char* text) { return text == nullptr ? "" : text; }

}  // namespace flytri::device
