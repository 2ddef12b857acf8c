#include "core/base/iso_time.h"

#include <fmt/chrono.h>

namespace flytri {

std::string iso_time(std::time_t time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(time));
}

}  // namespace flytri
