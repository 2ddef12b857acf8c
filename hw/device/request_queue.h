/// @file  Requests for lights in the order of posting; of several that are due only the last
/// counts.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "hw/device/light_switch.h"

namespace flytri::device {

struct NumberedRequest {
  std::int64_t number = 0;  ///< from 1; 0: no request
  LightRequest request;
};

/// A request whose turn has come.
struct DueRequest {
  NumberedRequest request;
  std::int64_t skipped = 0;  ///< requests before it whose turn has passed
};

class RequestQueue {
 public:
  /// Empty, and numbers begin anew.
  void clear() { *this = RequestQueue(); }

  /// @return  the request's number
  std::int64_t post(const LightRequest& request) {
    requests_.push_back({++last_number_, request});
    return last_number_;
  }

  /// When the first request is due; nothing: there is none.
  [[nodiscard]] std::optional<double> first_due_s() const {
    if (requests_.empty()) return std::nullopt;
    return requests_.front().request.not_before_s;
  }
  [[nodiscard]] bool is_due(double now_s) const {
    return !requests_.empty() && requests_.front().request.not_before_s <= now_s;
  }

  /// Takes out all requests up to the first one that is not due yet.
  /// @return  the last of them; nothing: none is due
  [[nodiscard]] std::optional<DueRequest> take_due(double now_s) {
    if (!is_due(now_s)) return std::nullopt;
    DueRequest due{requests_.front(), -1};
    for (; is_due(now_s); requests_.pop_front()) due = {requests_.front(), due.skipped + 1};
    return due;
  }

 private:
  std::deque<NumberedRequest> requests_;  // by their numbers
  std::int64_t last_number_ = 0;
};

}  // namespace flytri::device
