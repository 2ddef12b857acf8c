/// @file  Queue of light requests. If several are due, only the last one is returned.
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

/// A request to carry out now.
struct DueRequest {
  NumberedRequest request;
  std::int64_t skipped = 0;  ///< earlier requests that were due, too
};

class RequestQueue {
 public:
  /// Removes all requests; numbers start from 1 again.
  void clear() { *this = RequestQueue(); }

  /// @return  the request's number
  std::int64_t post(const LightRequest& request) {
    requests_.push_back({++last_number_, request});
    return last_number_;
  }

  /// When the first request is due; nothing if the queue is empty.
  [[nodiscard]] std::optional<double> first_due_s() const {
    if (requests_.empty()) return std::nullopt;
    return requests_.front().request.not_before_s;
  }
  [[nodiscard]] bool is_due(double now_s) const {
    return !requests_.empty() && requests_.front().request.not_before_s <= now_s;
  }

  /// Removes all requests before the first one that is not due yet.
  /// @return  the last removed one; nothing if none is due
  [[nodiscard]] std::optional<DueRequest> take_due(double now_s) {
    if (!is_due(now_s)) return std::nullopt;
    DueRequest due{requests_.front(), -1};
    for (; is_due(now_s); requests_.pop_front()) due = {requests_.front(), due.skipped + 1};
    return due;
  }

 private:
  std::deque<NumberedRequest> requests_;  // by increasing number
  std::int64_t last_number_ = 0;
};

}  // namespace flytri::device
