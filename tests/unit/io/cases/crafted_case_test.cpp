/// @file  Cases that somebody made by hand to do harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "core/io/cases/case_file.h"
#include "core/io/cases/sqlite.h"
#include "tests/support/case_samples.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;
using testing::sample_pose;
using testing::sample_view;

constexpr ScanStage kCraftedStage = ScanStage::kUpper;

TEST(CraftedCase, TheLibraryTakesOnlyWhatACaseNeeds) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "case.flytri";
  ASSERT_TRUE(CaseFile::create(path, {}));
  for (const SqliteAccess access : {SqliteAccess::kReadOnly, SqliteAccess::kReadWrite}) {
    SqliteDatabase database = SqliteDatabase::open(path, access).value();
    EXPECT_TRUE(database.run("SELECT count(*) FROM views"));
    EXPECT_FALSE(database.run("ATTACH ':memory:' AS other"));
    EXPECT_FALSE(database.run("SELECT 1 UNION SELECT 2"));
    const auto large = database.run("SELECT zeroblob(600000000)");
    ASSERT_FALSE(large);
    EXPECT_THAT(large.error().message, HasSubstr("case.flytri: damaged: a record is larger"));
  }
}

TEST(CraftedCase, WhatNoSensorCanMeasureIsLeftOut) {
  const TemporaryFolder folder;
  CaseFile file = CaseFile::create(folder / "case.flytri", {}).value();
  View wild = sample_view(0, 2, 10);
  wild.profiles[0].points[1].position_mm.x() = 1e30;
  const auto good = std::make_shared<const View>(sample_view(1, 2, 10));
  Isometry stretched = sample_pose(1);
  stretched.linear() *= 1e6;
  ASSERT_TRUE(file.append_view(kCraftedStage, wild));
  ASSERT_TRUE(file.append_view(kCraftedStage, *good));
  ASSERT_TRUE(file.write_poses(kCraftedStage, std::array{AlignedView{good, stretched}}));
  ASSERT_TRUE(file.commit());
  const StoredStage stage = file.load_stage(kCraftedStage).value();
  ASSERT_EQ(stage.views.size(), 1U);
  EXPECT_EQ(stage.views[0].view->frame, good->frame);
  EXPECT_FALSE(stage.views[0].T_world_sensor);
  EXPECT_EQ(stage.damage.size(), 2U);
}

}  // namespace
}  // namespace flytri::io
