#include "core/io/cases/case_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/cases/case_schema.h"
#include "core/io/cases/sqlite.h"
#include "core/io/files/file_bytes.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

CaseEvent event_of(CaseAction action) {
  CaseEvent event{action, "2026-11-24T07:10:11Z", "ada", "chair2", "flytri 0.1.0", {}, {}};
  if (action != CaseAction::kExported) return event;
  event.stage = ScanStage::kLower;
  event.files = {"/home/ada/Zoë\n.glb", "/home/ada/b.stl"};
  return event;
}

void note(CaseFile& file, CaseAction action) {
  ASSERT_TRUE(file.add_event(event_of(action)));
  ASSERT_TRUE(file.commit());
}

std::vector<CaseAction> actions_of(const fs::path& path, const CaseOptions& options = {}) {
  std::vector<CaseAction> actions;
  CaseFile file = CaseFile::open(path, options).value();
  const CaseJournal journal = file.journal().value();
  for (const CaseEvent& event : journal.events) actions.push_back(event.action);
  return actions;
}

TEST(CaseJournal, KeepsEntriesInOrder) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    for (const CaseAction action : kCaseActions) note(file, action);
  }
  CaseFile file = CaseFile::open(path, {{}, true}).value();
  const CaseJournal journal = file.journal().value();
  EXPECT_TRUE(journal.damage.empty());
  ASSERT_EQ(journal.events.size(), kCaseActions.size());
  for (std::size_t i = 0; i < kCaseActions.size(); ++i) {
    EXPECT_EQ(journal.events[i], event_of(kCaseActions[i]));
  }
  EXPECT_FALSE(file.add_event(event_of(CaseAction::kOpened))) << "open read-only";
}

TEST(CaseJournal, OnlyGrows) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    note(file, CaseAction::kCreated);
    note(file, CaseAction::kExported);
    // Clearing a stage, or saving everything anew, leaves it as it is.
    ASSERT_TRUE(file.clear_stage(ScanStage::kUpper));
    ASSERT_TRUE(file.commit());
  }
  for (const char* change :
       {"UPDATE events SET data = '{}' WHERE id = 1", "DELETE FROM events WHERE id = 2",
        "DELETE FROM events", "REPLACE INTO events VALUES (1, 0, '{}')",
        "INSERT OR REPLACE INTO events VALUES (2, 0, '{}')"}) {
    EXPECT_EQ(testing::run_sql(path, change), "the journal only grows") << change;
  }
  EXPECT_EQ(actions_of(path), (std::vector{CaseAction::kCreated, CaseAction::kExported}));
}

TEST(CaseJournal, AnOlderCaseGetsOneWhenItIsWritten) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  (void)CaseFile::create(path, {}, {"Ada", "", "", "", "", ""}).value();
  testing::make_version_1(path);
  const std::string before = read_file(path).value();
  EXPECT_EQ(actions_of(path, {{}, true}), std::vector<CaseAction>());
  EXPECT_EQ(read_file(path).value(), before) << "a case that is only read is not changed";
  {
    CaseFile file = CaseFile::open(path).value();
    EXPECT_FALSE(file.is_read_only());
    EXPECT_EQ(file.fields().value().patient_name, "Ada");
    note(file, CaseAction::kOpened);
  }
  EXPECT_EQ(actions_of(path), std::vector{CaseAction::kOpened});
  SqliteDatabase database = SqliteDatabase::open(path, SqliteAccess::kReadOnly).value();
  EXPECT_EQ(database.integer("PRAGMA user_version").value(), 2);
  EXPECT_EQ(database.integer("SELECT count(*) FROM sqlite_master WHERE type = 'trigger'").value(),
            3);
}

TEST(CaseJournal, MovesWithItsCase) {
  const TemporaryFolder folder;
  const fs::path from = folder / "a.flytri", to = folder / "b.flytri";
  CaseOptions encrypted;
  encrypted.passphrase = Secret("key");
  {
    CaseFile file = CaseFile::create(from, {}).value();
    note(file, CaseAction::kCreated);
    ASSERT_TRUE(file.add_event(event_of(CaseAction::kExported))) << "not committed yet";
    ASSERT_TRUE(file.move_to(to, encrypted));
    note(file, CaseAction::kMoved);
  }
  EXPECT_EQ(actions_of(to, encrypted),
            (std::vector{CaseAction::kCreated, CaseAction::kExported, CaseAction::kMoved}));
}

TEST(CaseJournal, EntriesWaitWhileTheDiskIsFull) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    ASSERT_TRUE(file.append_view(ScanStage::kUpper, testing::sample_view(0)));
    ASSERT_TRUE(file.commit());
    {
      const FullDisk disk(0);
      ASSERT_TRUE(file.append_view(ScanStage::kUpper, testing::sample_view(1)));
      ASSERT_FALSE(file.commit());
      EXPECT_FALSE(file.add_event(event_of(CaseAction::kOpened)));
      EXPECT_FALSE(file.add_event(event_of(CaseAction::kExported)));
    }
    ASSERT_TRUE(file.commit());
  }
  EXPECT_EQ(actions_of(path), (std::vector{CaseAction::kOpened, CaseAction::kExported}));
}

TEST(CaseJournal, ADamagedEntryCostsOnlyItself) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    for (const CaseAction action : kCaseActions) note(file, action);
  }
  std::string bytes = read_file(path).value();
  const std::size_t at = bytes.find("opened read-only");
  ASSERT_NE(at, std::string::npos);
  bytes[at] = 'O';
  ASSERT_TRUE(write_file(path, bytes));
  CaseFile file = CaseFile::open(path).value();
  const CaseJournal journal = file.journal().value();
  EXPECT_EQ(journal.events.size(), kCaseActions.size() - 1);
  ASSERT_EQ(journal.damage.size(), 1U);
  EXPECT_THAT(journal.damage[0], HasSubstr("events: record 3: wrong checksum"));
}

}  // namespace
}  // namespace flytri::io
