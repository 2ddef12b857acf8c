#include "core/base/workers.h"

#include <gtest/gtest.h>

#include <atomic>

namespace flytri {
namespace {

constexpr std::size_t kCount = 1000;

TEST(Workers, CallTheBodyOnceForEveryIndexAndAdvanceByOneStep) {
  for (const std::size_t grain : {1U, 7U, 5000U}) {
    const Progress progress;
    progress.begin_stage("Counting", 2);
    std::vector<int> calls(kCount, 0);
    EXPECT_TRUE(Workers(4).for_each_unless_cancelled(
        kCount, [&](std::size_t i) { ++calls[i]; }, progress, grain));
    EXPECT_EQ(calls, std::vector<int>(kCount, 1));
    // The sum of a thousand shares, each rounded to 1e-16.
    EXPECT_NEAR(progress.snapshot().fraction, 0.5, 1e-12);
  }
}

TEST(Workers, AnEmptyLoopAdvancesByOneStepToo) {
  const Progress progress;
  progress.begin_stage("Counting", 2);
  EXPECT_TRUE(Workers(2).for_each_unless_cancelled(
      0, [](std::size_t) { FAIL(); }, progress));
  EXPECT_DOUBLE_EQ(progress.snapshot().fraction, 0.5);
}

TEST(Workers, FinishOnlyRunningTasksAfterCancellation) {
  constexpr std::size_t kGrain = 10;
  for (const int threads : {1, 4}) {
    const Progress progress;
    std::atomic<std::size_t> calls = 0;
    const bool complete = Workers(threads).for_each_unless_cancelled(
        kCount,
        [&](std::size_t /*i*/) {
          // The task of the 25th call may be delayed by the machine, so later tasks cancel too.
          if (++calls >= 25) progress.cancel();
        },
        progress, kGrain);
    EXPECT_FALSE(complete);
    EXPECT_GE(calls, 25U);
    // The task of the 25th call, and at most one task of each other thread.
    EXPECT_LE(calls, 25U + kGrain * static_cast<std::size_t>(threads));
  }
}

TEST(Workers, CancellationInTheLastTaskStillCompletesTheLoop) {
  const Progress progress;
  EXPECT_TRUE(Workers(1).for_each_unless_cancelled(
      kCount,
      [&](std::size_t i) {
        if (i == kCount - 1) progress.cancel();
      },
      progress, 10));
}

TEST(ForEachInOrder, CallsInRisingOrderAndStopsWhenCanceled) {
  const Progress progress;
  std::vector<std::size_t> seen;
  const auto body = [&](std::size_t i) {
    seen.push_back(i);
    if (i == 4) progress.cancel();
  };
  EXPECT_FALSE(for_each_in_order(kCount, body, progress, 3));
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace flytri
