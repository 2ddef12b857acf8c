#include "core/base/progress.h"

#include <gtest/gtest.h>

namespace flytri {
namespace {

TEST(Progress, SharesOfPartsAddUpToTheWholeStage) {
  const Progress progress;
  progress.begin_stage("Meshing", 2);
  EXPECT_EQ(progress.snapshot().stage, "Meshing");
  EXPECT_EQ(progress.snapshot().fraction, 0.0);
  progress.advance();
  EXPECT_DOUBLE_EQ(progress.snapshot().fraction, 0.5);
  const Progress part = progress.part(0.5);
  part.advance(0.5);
  EXPECT_DOUBLE_EQ(progress.snapshot().fraction, 0.5 + 0.25 / 2.0);
  part.part(0.5).advance();
  EXPECT_DOUBLE_EQ(progress.snapshot().fraction, 0.75);
}

TEST(Progress, FractionNeverExceedsOne) {
  const Progress progress;
  progress.begin_stage("Meshing");
  progress.advance(1.5);
  EXPECT_EQ(progress.snapshot().fraction, 1.0);
  progress.begin_stage("Texturing");
  EXPECT_EQ(progress.snapshot().fraction, 0.0);
}

TEST(Progress, CancelingAPartCancelsTheWholeWork) {
  const Progress progress;
  progress.part(0.5).cancel();
  EXPECT_TRUE(progress.cancelled());
}

TEST(Progress, WatchIsCalledAtEveryAdvance) {
  std::vector<double> told;
  const Progress progress([&](const Progress::Snapshot& step) { told.push_back(step.fraction); });
  progress.begin_stage("Meshing", 4);
  for (int i = 0; i < 4; ++i) progress.advance();
  EXPECT_EQ(told, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
}

}  // namespace
}  // namespace flytri
