/// @file  Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "core/base/progress.h"

namespace flytri {

/// A copyable handle to a limited set of threads.
///
/// A loop body must write only to data of its own index; sums are formed afterwards, in order. Then
/// one thread and many threads give the same bits.
class Workers {
 public:
  /// @param thread_count  0: as many as the machine has cores.
  explicit Workers(int thread_count = 0);

  [[nodiscard]] int thread_count() const;

  /// Calls body(i) once for every i in [0, count), in any order. A task covers `grain` consecutive
  /// indices.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& body,
                std::size_t grain = 1) const;

  /// Same as for_each, but advances `progress` by one step in total and stops when it is canceled.
  /// A running task is finished.
  /// @returns false if the loop was canceled before it called body for every i
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
