/// @file  One thread that runs tasks in the order in which they were posted.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace flytri {

/// The queue is unbounded: the caller limits what it posts.
class TaskThread {
 public:
  enum class Priority {
    kNormal,
    kBackground  ///< runs when no other thread needs the processor
  };
  explicit TaskThread(Priority priority = Priority::kNormal);
  ~TaskThread() { stop(); }
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  /// Does nothing after stop().
  void post(std::function<void()> task);
  /// Finishes the current task and drops the waiting ones. The thread cannot be started again.
  void stop();
  /// Number of waiting and running tasks.
  [[nodiscard]] std::size_t pending() const;
  /// Waits until no task is waiting or running. Must not be called from a task.
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
