#include "core/base/iso_time.h"

#include <fmt/chrono.h>

namespace flytri {

std::string iso_time(std::time_t time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(time));
}

std::string readable_time(const std::string& time) {
  const auto parsed = parse_iso_time(time);
  return parsed ? fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(*parsed)) : "not known";
}

std::optional<std::time_t> parse_iso_time(const std::string& text) {
  std::tm parts = {};
  const char* end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  if (end == nullptr || *end != '\0') return std::nullopt;
  return timegm(&parts);
}

}  // namespace flytri
