/// @file  Wishes for lights in the order of posting; of several that are due only the last counts.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "hw/device/light_switch.h"

namespace flytri {

struct NumberedWish {
  std::int64_t number = 0;  ///< from 1; 0: no wish
  LightWish wish;
};

/// A wish whose turn has come.
struct DueWish {
  NumberedWish wish;
  std::int64_t skipped = 0;  ///< wishes before it whose turn has passed
};

class WishQueue {
 public:
  /// Empty, and numbers begin anew.
  void clear() { *this = WishQueue(); }

  /// @return  the wish's number
  std::int64_t post(const LightWish& wish) {
    wishes_.push_back({++last_number_, wish});
    return last_number_;
  }

  /// When the first wish is due; nothing: there is none.
  [[nodiscard]] std::optional<double> first_due_s() const {
    if (wishes_.empty()) return std::nullopt;
    return wishes_.front().wish.not_before_s;
  }
  [[nodiscard]] bool is_due(double now_s) const {
    return !wishes_.empty() && wishes_.front().wish.not_before_s <= now_s;
  }

  /// Takes out all wishes up to the first one that is not due yet.
  /// @return  the last of them; nothing: none is due
  [[nodiscard]] std::optional<DueWish> take_due(double now_s) {
    if (!is_due(now_s)) return std::nullopt;
    DueWish due{wishes_.front(), -1};
    for (; is_due(now_s); wishes_.pop_front()) due = {wishes_.front(), due.skipped + 1};
    return due;
  }

 private:
  std::deque<NumberedWish> wishes_;  // by their numbers
  std::int64_t last_number_ = 0;
};

}  // namespace flytri
