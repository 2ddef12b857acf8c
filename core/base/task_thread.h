/// @file  One thread that carries out tasks in the order they were posted.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace flytri {

/// Unbounded: whoever posts sees to it that no more is posted than gets done.
class TaskThread {
 public:
  enum class Priority {
    kNormal,
    kBackground  ///< gets what the others leave of the processor
  };
  explicit TaskThread(Priority priority = Priority::kNormal);
  ~TaskThread() { stop(); }
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  /// Nothing happens once the thread is stopped.
  void post(std::function<void()> task);
  /// Finishes the task at hand and drops the others, for good.
  void stop();
  /// Tasks that wait or run.
  [[nodiscard]] std::size_t pending() const;
  /// Waits until nothing is left to do. Not to be called from a task.
  void wait_until_idle() const;

 private:
  void run(Priority priority);

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool busy_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace flytri
