/// @file  Text from C libraries, which may be a null pointer.
#pragma once

#include <string>

namespace flytri::device {

/// @param text  may be null; the result is then empty
[[nodiscard]] inline std::string c_text(const char* text) { return text == nullptr ? "" : text; }

}  // namespace flytri::device
