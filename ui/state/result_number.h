/// @file  Tells results apart: each has a number of its own, even where a later one lies at the
/// address of a former one.
#pragma once

#include <cstdint>
#include <memory>

namespace flytri::ui {

class ResultNumber {
 public:
  /// @return  the same number as the last time if it is the same result, else the next number
  [[nodiscard]] std::uint64_t of(const std::shared_ptr<const void>& result);

 private:
  /// Compared by owner, not by address: the owner is kept from being reused.
  std::weak_ptr<const void> latest_;
  std::uint64_t number_ = 0;
};

}  // namespace flytri::ui
