/// @file  Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "core/base/progress.h"

namespace flytri {

/// A copyable handle to a bounded set of threads.
///
/// Every loop body writes only to what its own index owns; sums are formed afterwards, in order.
/// So one thread and many give the same bits.
class Workers {
 public:
  /// @param thread_count  0 takes as many as the machine has cores.
  explicit Workers(int thread_count = 0);

  [[nodiscard]] int thread_count() const;

  /// Calls body(i) once for every i in [0, count), in any order, `grain` consecutive ones a task.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& body,
                std::size_t grain = 1) const;

  /// The same, advancing `progress` by one step in all, until that is cancelled; a task that has
  /// begun is ended.
  /// @returns false if the loop was cancelled before body was called for every i
  [[nodiscard]] bool for_each_unless_cancelled(std::size_t count,
                                               const std::function<void(std::size_t)>& body,
                                               const Progress& progress,
                                               std::size_t grain = 1) const;

 private:
  struct Arena;
  std::shared_ptr<Arena> arena_;
};

/// Calls body(i) for i from 0 to count - 1, in this order, on the calling thread; otherwise like
/// Workers::for_each_unless_cancelled.
[[nodiscard]] bool for_each_in_order(std::size_t count,
                                     const std::function<void(std::size_t)>& body,
                                     const Progress& progress, std::size_t grain = 1);

}  // namespace flytri
