#include "core/scan/frame_intake.h"

#include <gtest/gtest.h>

#include <thread>

namespace flytri::scan {
namespace {

Frame frame(int index) {
  Frame frame;
  frame.index = FrameIndex(index);
  frame.time_s = index;
  return frame;
}

measurement::MeasuredView measured(const FrameIntake::Task& task) {
  measurement::MeasuredView view;
  view.view.frame = task.frame.index;
  return view;
}

TEST(FrameIntake, ResultsHaveTheOrderOfTheFrames) {
  FrameIntake intake(8);
  for (int i = 0; i < 3; ++i) intake.offer(frame(i), 0.5 * i);
  std::vector<FrameIntake::Task> tasks;
  for (int i = 0; i < 3; ++i) tasks.push_back(*intake.take());
  for (int i = 2; i >= 0; --i) intake.deliver(tasks[i].number, measured(tasks[i]));
  for (int i = 0; i < 3; ++i) {
    const auto result = intake.next();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->frame.index, FrameIndex(i));
    EXPECT_EQ(result->measured->view.frame, FrameIndex(i));
    EXPECT_EQ(result->offered_at_s, 0.5 * i);
    EXPECT_FALSE(result->skipped);
  }
}

TEST(FrameIntake, AFullQueueSkipsTheOldestWaitingFrame) {
  FrameIntake intake(3);
  intake.offer(frame(0), 0.0);
  const FrameIntake::Task begun = *intake.take();
  for (int i = 1; i < 5; ++i) intake.offer(frame(i), 0.0);  // two more than fit
  intake.deliver(begun.number, measured(begun));
  EXPECT_FALSE(intake.next()->skipped);
  EXPECT_TRUE(intake.next()->skipped);
  EXPECT_TRUE(intake.next()->skipped);
  EXPECT_EQ(intake.take()->frame.index, FrameIndex(3));
  EXPECT_EQ(intake.take()->frame.index, FrameIndex(4));
}

TEST(FrameIntake, SkipsTheNewFrameIfTheReaderIsLate) {
  FrameIntake intake(2);
  for (int i = 0; i < 2; ++i) intake.offer(frame(i), 0.0);
  for (int i = 0; i < 2; ++i) {
    const FrameIntake::Task task = *intake.take();
    intake.deliver(task.number, measured(task));
  }
  EXPECT_EQ(intake.backlog(), 2U);
  intake.offer(frame(2), 0.0);
  EXPECT_FALSE(intake.next()->skipped);
  EXPECT_FALSE(intake.next()->skipped);
  EXPECT_TRUE(intake.next()->skipped);
}

TEST(FrameIntake, EachFrameComesOutOnceUnderLoad) {
  constexpr int kFrames = 2000;
  FrameIntake intake(4);
  const auto work = [&] {
    while (const auto task = intake.take()) intake.deliver(task->number, measured(*task));
  };
  std::thread first(work), second(work);
  std::thread source([&] {
    for (int i = 0; i < kFrames; ++i) intake.offer(frame(i), 0.0);
  });
  for (int i = 0; i < kFrames; ++i) {
    const auto result = intake.next();
    ASSERT_TRUE(result);
    ASSERT_EQ(result->frame.index, FrameIndex(i));
  }
  source.join();
  intake.close();
  first.join();
  second.join();
}

TEST(FrameIntake, WakeAndCloseEndTheWaiting) {
  FrameIntake intake(2);
  std::thread waker([&] { intake.wake(); });
  EXPECT_FALSE(intake.next());
  waker.join();
  std::thread closer([&] { intake.close(); });
  EXPECT_FALSE(intake.take());
  closer.join();
  EXPECT_FALSE(intake.next());
}

}  // namespace
}  // namespace flytri::scan
