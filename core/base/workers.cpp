#include "core/base/workers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#ifdef FLYTRI_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace flytri {
namespace {

/// What a loop needs is written before it begins, and what it writes is read after it ended. The
/// thread sanitizer has to be told, as TBB and this file are built without it. Tasks are not
/// ordered among each other: a race between two of them is found.
class Handover {
 public:
  Handover() { release(before_); }
  void begin_task() { acquire(before_); }
  void end_task() { release(after_); }
  void end_loop() { acquire(after_); }

 private:
#ifdef FLYTRI_THREAD_SANITIZER
  static void acquire(char& place) { __tsan_acquire(&place); }
  static void release(char& place) { __tsan_release(&place); }
#else
  static void acquire(char&) {}
  static void release(char&) {}
#endif
  char before_ = 0, after_ = 0;
};

}  // namespace

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
  Handover handover;
  arena_->arena.execute([&] {
    tbb::parallel_for(Range(0, count, std::max<std::size_t>(grain, 1)), [&](const Range& range) {
      handover.begin_task();
      run_range(range.begin(), range.end());
      handover.end_task();
    });
  });
  handover.end_loop();
}

}  // namespace flytri
