#include "ui/state/result_number.h"

namespace flytri::ui {

std::uint64_t ResultNumber::of(const std::shared_ptr<const void>& result) {
  const bool is_same = !latest_.owner_before(result) && !result.owner_before(latest_);
  if (!is_same) ++number_;
  latest_ = result;
  return number_;
}

}  // namespace flytri::ui
