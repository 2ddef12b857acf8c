/// @file  Cases that somebody made by hand to do harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "core/io/cases/case_file.h"
#include "core/io/cases/sqlite.h"
#include "core/io/files/file_bytes.h"
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

TEST(CraftedCase, NothingElseIsRunOnACase) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "case.flytri";
  ASSERT_TRUE(CaseFile::create(path, {}));
  const std::string before = read_file(path).value();
  for (const SqliteAccess access : {SqliteAccess::kReadOnly, SqliteAccess::kReadWrite}) {
    SqliteDatabase database = SqliteDatabase::open(path, access).value();
    for (const char* sql :
         {"ATTACH ':memory:' AS other", "DROP TABLE views", "DROP TRIGGER events_delete",
          "UPDATE fields SET data = ''", "ALTER TABLE views RENAME TO other",
          "CREATE VIEW other AS SELECT * FROM views", "CREATE INDEX other ON views (data)",
          "CREATE VIRTUAL TABLE other USING fts4(data)", "SELECT load_extension('other')",
          "SELECT hex(data) FROM views", "PRAGMA recursive_triggers = ON",
          "PRAGMA ignore_check_constraints = ON", "ANALYZE"}) {
      EXPECT_FALSE(database.run(sql)) << sql;
    }
    EXPECT_EQ(database.run("PRAGMA writable_schema = ON").has_value(),
              access == SqliteAccess::kReadOnly);
  }
  EXPECT_EQ(read_file(path).value(), before);
}

/// Each is refused before a statement touches its tables, and stays as it was.
TEST(CraftedCase, AnotherSchemaIsRefused) {
  const std::string long_name(70'000, 'x');
  const std::string into_schema =
      "PRAGMA writable_schema = ON; INSERT INTO sqlite_master VALUES ('table', 'a', 'a', 0, ";
  const std::vector<std::string> crafted = {
      "CREATE TRIGGER a AFTER INSERT ON views BEGIN DELETE FROM fields; END",
      "CREATE TRIGGER a AFTER DELETE ON edits BEGIN UPDATE models SET data = ''; END",
      "DROP TRIGGER events_delete",
      "DROP TRIGGER events_delete; CREATE TRIGGER events_delete BEFORE DELETE ON events BEGIN "
      "DELETE FROM fields; END",
      "DROP TABLE poses; CREATE VIEW poses AS SELECT id, checksum, data FROM fields",
      "CREATE VIEW a AS SELECT * FROM fields",
      "CREATE TABLE a (b)",
      "CREATE INDEX a ON views (data)",
      "DROP TABLE poses; CREATE VIRTUAL TABLE poses USING fts4(id, checksum, data)",
      into_schema + "'CREATE VIRTUAL TABLE a USING fts4(b)')",
      into_schema + "'CREATE TABLE a (" + long_name + ")')",
      into_schema + "'DELETE FROM fields')",
      into_schema + "'CREATE TABLE a (b DEFAULT (load_extension(''c'')))')"};
  for (const std::string& sql : crafted) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "case.flytri";
    ASSERT_TRUE(CaseFile::create(path, {}, {"Ada", "", "", "", "", ""}));
    ASSERT_EQ(testing::run_sql(path, sql), "") << sql.substr(0, 200);
    const std::string before = read_file(path).value();
    for (const bool is_read_only : {false, true}) {
      const auto opened = CaseFile::open(path, {{}, is_read_only});
      ASSERT_FALSE(opened) << sql.substr(0, 200);
      EXPECT_EQ(opened.error().code, ErrorCode::kBadFormat) << opened.error().message;
      EXPECT_THAT(opened.error().message, HasSubstr("case.flytri: damaged"));
    }
    EXPECT_EQ(read_file(path).value(), before);
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
