#include "core/base/task_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace flytri {
namespace {

TEST(TaskThread, RunsTasksInOrder) {
  std::vector<int> done;
  TaskThread thread;
  for (int i = 0; i < 100; ++i) thread.post([&done, i] { done.push_back(i); });
  thread.wait_until_idle();
  ASSERT_EQ(done.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(done[i], i);
  EXPECT_EQ(thread.pending(), 0U);
}

TEST(TaskThread, ATaskMayPostAnotherTask) {
  std::atomic<int> count = 0;
  TaskThread thread(TaskThread::Priority::kBackground);
  thread.post([&] {
    ++count;
    thread.post([&] { ++count; });
  });
  thread.wait_until_idle();
  EXPECT_EQ(count, 2);
}

TEST(TaskThread, StopDropsWaitingTasks) {
  std::atomic<bool> goes_on = false;
  std::atomic<int> count = 0;
  TaskThread thread;
  thread.post([&] {
    while (!goes_on) std::this_thread::yield();
    ++count;
  });
  thread.post([&] { ++count; });
  std::thread stopper([&] { thread.stop(); });
  while (thread.pending() > 1) std::this_thread::yield();
  goes_on = true;
  stopper.join();
  EXPECT_LE(count, 1);
  const int before = count;
  thread.post([&] { ++count; });
  EXPECT_EQ(count, before);
}

}  // namespace
}  // namespace flytri
