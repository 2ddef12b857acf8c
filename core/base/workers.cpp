#include "core/base/workers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace flytri {

struct Workers::Arena {
  tbb::task_arena arena;
};

Workers::Workers(int thread_count)
    : arena_(std::make_shared<Arena>(
          Arena{tbb::task_arena(thread_count > 0 ? thread_count : tbb::task_arena::automatic)})) {}

int Workers::thread_count() const { return arena_->arena.max_concurrency(); }

void Workers::for_each(std::size_t count, const std::function<void(std::size_t)>& body,
                       std::size_t grain) const {
  const auto run_range = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  };
  if (thread_count() == 1 || count <= grain) return run_range(0, count);
  using Range = tbb::blocked_range<std::size_t>;
  arena_->arena.execute([&] {
    tbb::parallel_for(Range(0, count, std::max<std::size_t>(grain, 1)),
                      [&](const Range& range) { run_range(range.begin(), range.end()); });
  });
}

}  // namespace flytri
