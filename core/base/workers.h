/// @file  Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

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

 private:
  struct Arena;
  std::shared_ptr<Arena> arena_;
};

}  // namespace flytri
