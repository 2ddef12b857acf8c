#include "core/base/workers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#ifdef FLYTRI_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace flytri {
namespace {

/// Tells the thread sanitizer that a loop's input is written before it begins and its output is
/// read after it ends: TBB and this file are built without that sanitizer. Tasks are not ordered
/// among each other, so races between two tasks are still found.
class SanitizerOrder {
 public:
  SanitizerOrder() { release(before_); }
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

/// A loop cut into pieces. Cancellation is checked before each piece, progress is reported after
/// it.
class PiecewiseLoop {
 public:
  PiecewiseLoop(std::size_t count, const std::function<void(std::size_t)>& body,
                const Progress& progress, std::size_t grain)
      : count_(count), body_(body), progress_(progress), grain_(std::max<std::size_t>(grain, 1)) {
    if (count == 0) progress.advance();
  }

  [[nodiscard]] std::size_t piece_count() const { return (count_ + grain_ - 1) / grain_; }

  /// @returns false if the loop was canceled and the piece skipped
  [[nodiscard]] bool run_piece(std::size_t piece) const {
    if (progress_.cancelled()) return false;
    const std::size_t begin = piece * grain_;
    const std::size_t end = std::min(count_, begin + grain_);
    for (std::size_t i = begin; i < end; ++i) body_(i);
    progress_.advance(static_cast<double>(end - begin) / static_cast<double>(count_));
    return true;
  }

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& body_;
  const Progress& progress_;
  std::size_t grain_;
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
  SanitizerOrder order;
  arena_->arena.execute([&] {
    tbb::parallel_for(Range(0, count, std::max<std::size_t>(grain, 1)), [&](const Range& range) {
      order.begin_task();
      run_range(range.begin(), range.end());
      order.end_task();
    });
  });
  order.end_loop();
}

bool Workers::for_each_unless_cancelled(std::size_t count,
                                        const std::function<void(std::size_t)>& body,
                                        const Progress& progress, std::size_t grain) const {
  const PiecewiseLoop loop(count, body, progress, grain);
  std::atomic<bool> complete = true;
  for_each(loop.piece_count(), [&](std::size_t piece) {
    if (!loop.run_piece(piece)) complete = false;
  });
  return complete;
}

bool for_each_in_order(std::size_t count, const std::function<void(std::size_t)>& body,
                       const Progress& progress, std::size_t grain) {
  const PiecewiseLoop loop(count, body, progress, grain);
  for (std::size_t piece = 0; piece < loop.piece_count(); ++piece) {
    if (!loop.run_piece(piece)) return false;
  }
  return true;
}

}  // namespace flytri
