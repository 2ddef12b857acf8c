#include "core/base/check_options.h"

namespace flytri {

OptionCheck& OptionCheck::positive(std::string_view field, double value) {
  return above(field, value, 0.0);
}

OptionCheck& OptionCheck::not_negative(std::string_view field, double value) {
  return at_least(field, value, 0.0);
}

OptionCheck& OptionCheck::above(std::string_view field, double value, double bound) {
  if (valid_ && !(value > bound)) {
    refuse(field, fmt::format("{}", value), fmt::format("above {}", bound));
  }
  return *this;
}

OptionCheck& OptionCheck::at_least(std::string_view field, double value, double least) {
  if (valid_ && !(value >= least)) {
    refuse(field, fmt::format("{}", value), fmt::format("at least {}", least));
  }
  return *this;
}

OptionCheck& OptionCheck::in_range(std::string_view field, double value, double low, double high) {
  if (valid_ && !(value >= low && value <= high)) {
    refuse(field, fmt::format("{}", value), fmt::format("from {} to {}", low, high));
  }
  return *this;
}

OptionCheck& OptionCheck::positive_up_to(std::string_view field, double value, double high) {
  if (valid_ && !(value > 0.0 && value <= high)) {
    refuse(field, fmt::format("{}", value), fmt::format("above 0 and at most {}", high));
  }
  return *this;
}

void OptionCheck::refuse(std::string_view field, const std::string& value, std::string_view rule) {
  valid_ = fail(ErrorCode::kBadOption, "{}.{} is {}, but must be {}", options_, field, value, rule);
}

}  // namespace flytri
