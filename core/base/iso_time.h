/// @file  Points in time as text.
#pragma once

#include <ctime>
#include <optional>
#include <string>

namespace flytri {

/// ISO 8601 in UTC: "2026-11-25T08:30:00Z".
[[nodiscard]] std::string iso_time(std::time_t time);
/// "2026-11-25 08:30 UTC" for such a text, "not known" for any other.
[[nodiscard]] std::string readable_time(const std::string& time);
/// The reverse of iso_time. None: the text is no such time.
[[nodiscard]] std::optional<std::time_t> parse_iso_time(const std::string& text);

}  // namespace flytri
