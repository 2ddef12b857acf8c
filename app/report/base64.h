/// @file  Bytes as text, to embed a picture in a page.
#pragma once

#include <string>
#include <string_view>

namespace flytri::report {

/// @source  RFC 4648, section 4.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace flytri::report
