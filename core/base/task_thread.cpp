#include "core/base/task_thread.h"

#include <sys/resource.h>

#include <utility>

namespace flytri {

TaskThread::TaskThread(Priority priority) : thread_([this, priority] { run(priority); }) {}

void TaskThread::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void TaskThread::post(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return;
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

std::size_t TaskThread::pending() const {
  const std::lock_guard lock(mutex_);
  return tasks_.size() + (busy_ ? 1 : 0);
}

void TaskThread::wait_until_idle() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return tasks_.empty() && !busy_; });
}

void TaskThread::run(Priority priority) {
  // On Linux this sets the priority of the calling thread only. If the system refuses, the thread
  // keeps its priority.
  constexpr int kLowestPriority = 19;
  if (priority == Priority::kBackground) setpriority(PRIO_PROCESS, 0, kLowestPriority);
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
    if (stopping_) return;
    std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    busy_ = true;
    lock.unlock();
    task();
    task = nullptr;  // release its captures before the thread counts as idle
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace flytri
