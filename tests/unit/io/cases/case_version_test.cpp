/// @file  A case gets the version that its stages need: older programs open those that they know
/// whole, and refuse the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/cases/case_file.h"
#include "core/io/cases/sqlite.h"
#include "core/io/files/file_bytes.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using testing::sample_view;

std::int64_t version_of(const fs::path& path) {
  SqliteDatabase database = SqliteDatabase::open(path, SqliteAccess::kReadOnly).value();
  return database.integer("PRAGMA user_version").value();
}

void add_view(CaseFile& file, ScanStage stage, int frame) {
  ASSERT_TRUE(file.append_view(stage, sample_view(frame)));
  ASSERT_TRUE(file.commit());
}

TEST(CaseVersion, OnlyALaterStageRaisesIt) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  for (const ScanStage stage : {ScanStage::kUpper, ScanStage::kLower, ScanStage::kBite}) {
    CaseFile file =
        fs::exists(path) ? CaseFile::open(path).value() : CaseFile::create(path, {}).value();
    add_view(file, stage, 1);
  }
  EXPECT_EQ(version_of(path), 2) << "programs of version 2 read all of it";
  {
    CaseFile file = CaseFile::open(path).value();
    add_view(file, ScanStage::kBite2, 5);
    add_view(file, ScanStage::kBite2, 6);
  }
  EXPECT_EQ(version_of(path), 3);
  CaseFile file = CaseFile::open(path).value();
  EXPECT_EQ(file.load_stage(ScanStage::kBite2)->views.size(), 2U);
  EXPECT_EQ(file.load_stage(ScanStage::kBite)->views.size(), 1U);
  EXPECT_FALSE(file.is_damaged());
}

TEST(CaseVersion, WhatIsNotCommittedRaisesNothing) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    ASSERT_TRUE(file.append_view(ScanStage::kBite2, sample_view(1)));
  }
  EXPECT_EQ(version_of(path), 2);
}

/// The transaction that raised the version was rolled back. The next one raises it again.
TEST(CaseVersion, AFullDiskDoesNotSeparateAStageFromItsVersion) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    {
      const FullDisk limit(fs::file_size(path));
      (void)file.append_view(ScanStage::kBite2, sample_view(1));
      ASSERT_FALSE(file.commit());
      ASSERT_TRUE(file.has_waiting());
    }
    ASSERT_TRUE(file.commit());
  }
  EXPECT_EQ(version_of(path), 3);
  EXPECT_EQ(CaseFile::open(path)->counts(ScanStage::kBite2)->views, 1);
}

TEST(CaseVersion, CopiesHaveIt) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri", moved = folder / "b.flytri",
                 rescued = folder / "c.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  add_view(file, ScanStage::kBite2, 1);
  ASSERT_TRUE(file.move_to(moved, {}));
  const CaseSurvey survey = file.rescue_to(rescued).value();
  EXPECT_EQ(survey.readable[index_of(ScanStage::kBite2)].views, 1);
  EXPECT_EQ(version_of(rescued), 3);
  file = CaseFile::create(path, {}).value();
  EXPECT_EQ(version_of(moved), 3);
  EXPECT_EQ(CaseFile::open(moved)->counts(ScanStage::kBite2)->views, 1);
}

TEST(CaseVersion, ACaseOfVersion1GetsAJournalAndKeepsItsStages) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    add_view(file, ScanStage::kBite, 1);
  }
  testing::make_version_1(path);
  EXPECT_EQ(CaseFile::open(path)->counts(ScanStage::kBite)->views, 1);
  EXPECT_EQ(version_of(path), 2);
}

}  // namespace
}  // namespace flytri::io
