/// @file  Cases that are damaged or truncated, files that are not cases, and killed writers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/base/random.h"
#include "core/io/cases/case_file.h"
#include "core/io/cases/sqlite.h"
#include "core/io/files/file_bytes.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::same_bits;
using testing::sample_edit;
using testing::sample_pose;
using testing::sample_texture;
using testing::sample_view;

constexpr ScanStage kDamagedStage = ScanStage::kUpper;
constexpr int kViews = 40;

/// Small views that share a page, and large views that fill several pages.
View view_of(int frame) { return sample_view(frame, 2, frame % 4 == 0 ? 300 : 10); }

void expect_done(const Result<void>& result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
}

/// Writes a case with records in every table, and returns the bytes of its file.
std::string case_bytes(const fs::path& path, const std::string& passphrase = {}) {
  {
    CaseFile file = CaseFile::create(path, {Secret(passphrase), false}).value();
    for (int i = 0; i < kViews; ++i) {
      const auto view = std::make_shared<const View>(view_of(i));
      expect_done(file.append_view(kDamagedStage, *view));
      expect_done(file.write_poses(kDamagedStage, std::array{AlignedView{view, sample_pose(i)}}));
    }
    expect_done(file.append_texture(kDamagedStage, sample_texture(kViews)));
    editing::EditStack edits;
    for (int i = 0; i < 5; ++i) edits.push(sample_edit(i));
    expect_done(file.write_edits(kDamagedStage, edits));
    (void)file.add_measurement(kDamagedStage, {0, Vec3::Zero(), Vec3::Ones(), "a"}).value();
    expect_done(file.write_result(kDamagedStage, {std::string(50000, 'x'), "{}"}));
    expect_done(file.commit());
  }
  return read_file(path).value();
}

/// What could be read from a damaged case.
struct Salvage {
  bool opened = false;
  std::size_t views = 0, poses = 0;
  bool read_only = false;
  std::size_t damage = 0;
};

/// Opens and loads a case. All that is read must be correct, and a failure must name the file.
Salvage salvage(const fs::path& path, const CaseOptions& options = {}) {
  Result<CaseFile> file = CaseFile::open(path, options);
  if (!file) {
    EXPECT_THAT(file.error().message, HasSubstr(path.string()));
    return {};
  }
  const Result<StoredStage> stage = file->load_stage(kDamagedStage);
  if (!stage) {
    EXPECT_THAT(stage.error().message, HasSubstr(path.string()));
    return {};
  }
  Salvage result{true, stage->views.size(), 0, false, file->damage().size() + stage->damage.size()};
  if (!file->load_result(kDamagedStage)) ++result.damage;
  result.read_only = file->is_read_only();
  for (const StoredView& stored : stage->views) {
    const int frame = stored.view->frame.value;
    EXPECT_TRUE(same_bits(*stored.view, view_of(frame)));
    if (!stored.T_world_sensor) continue;
    ++result.poses;
    EXPECT_TRUE(same_bits(*stored.T_world_sensor, sample_pose(frame)));
  }
  for (const auto& edit : *stage->edits.all()) {
    EXPECT_EQ(edit->dabs.size(), 3U);
  }
  (void)file->counts(kDamagedStage);
  (void)file->fields();
  return result;
}

void spoil(const fs::path& path, const std::string& bytes) {
  for (const char* ending : {"-wal", "-shm"}) fs::remove(path.string() + ending);
  ASSERT_TRUE(write_file(path, bytes));
}

TEST(CaseDamage, OpensATruncatedCase) {
  const TemporaryFolder folder;
  const std::string whole = case_bytes(folder / "whole.flytri");
  const fs::path path = folder / "cut.flytri";
  std::size_t opened_count = 0, most = 0;
  for (std::size_t size = 0; size < whole.size(); size += whole.size() / 61 + 1) {
    spoil(path, whole.substr(0, size));
    const Salvage left = salvage(path);
    if (!left.opened) continue;
    EXPECT_TRUE(left.read_only) << size;
    EXPECT_GT(left.damage, 0U) << size;
    ++opened_count;
    most = std::max(most, left.views);
  }
  // Only the pages with the roots of the tables are needed.
  EXPECT_GT(opened_count, 20U);
  EXPECT_GE(most, kViews - 1U);
}

TEST(CaseDamage, LeavesATruncatedCaseUnchanged) {
  const TemporaryFolder folder;
  const std::string whole = case_bytes(folder / "whole.flytri");
  const fs::path path = folder / "cut.flytri";
  const std::string cut = whole.substr(0, whole.size() / 2);
  spoil(path, cut);
  EXPECT_TRUE(salvage(path).opened);
  EXPECT_EQ(read_file(path).value_or(""), cut);
}

TEST(CaseDamage, AFlippedByteCostsOneRecord) {
  const TemporaryFolder folder;
  const std::string whole = case_bytes(folder / "whole.flytri");
  const fs::path path = folder / "flipped.flytri";
  Random random(11);
  std::size_t opened_count = 0, view_count = 0;
  constexpr std::size_t kTries = 150;
  for (std::size_t i = 0; i < kTries; ++i) {
    std::string bytes = whole;
    bytes[random.below(bytes.size())] ^= static_cast<char>(1 + random.below(255));
    spoil(path, bytes);
    const Salvage left = salvage(path);
    opened_count += left.opened ? 1 : 0;
    view_count += left.views;
  }
  // Of about 30 pages, one contains the list of tables, and one for each table its root.
  EXPECT_GT(opened_count, kTries * 9 / 10);
  EXPECT_GT(view_count, opened_count * kViews * 9 / 10);
}

TEST(CaseDamage, SurvivesManyFlippedBytes) {
  const TemporaryFolder folder;
  const std::string whole = case_bytes(folder / "whole.flytri");
  const fs::path path = folder / "flipped.flytri";
  Random random(12);
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    for (int n = 0; n < 200; ++n)
      bytes[random.below(bytes.size())] = static_cast<char>(random.next());
    spoil(path, bytes);
    (void)salvage(path, {{}, i % 2 == 0});
  }
}

TEST(CaseDamage, OpensADamagedEncryptedCase) {
  const TemporaryFolder folder;
  const std::string whole = case_bytes(folder / "whole.flytri", "key");
  const fs::path path = folder / "flipped.flytri";
  Random random(13);
  std::size_t opened_count = 0, view_count = 0;
  for (int i = 0; i < 8; ++i) {
    std::string bytes = whole;
    bytes[bytes.size() / 4 + random.below(bytes.size() * 3 / 4)] ^= 1;
    spoil(path, bytes);
    const Salvage left = salvage(path, {Secret("key"), false});
    opened_count += left.opened ? 1 : 0;
    view_count += left.views;
  }
  EXPECT_GE(opened_count, 7U);
  EXPECT_GT(view_count, opened_count * kViews * 3 / 4);
}

TEST(CaseDamage, RefusesANewerVersion) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  (void)case_bytes(path);
  {
    SqliteDatabase database = SqliteDatabase::open(path, SqliteAccess::kReadWrite).value();
    ASSERT_TRUE(database.run("PRAGMA user_version = 4"));
  }
  const Result<CaseFile> file = CaseFile::open(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::kBadFormat);
  EXPECT_THAT(file.error().message, HasSubstr("version 4"));
  EXPECT_THAT(file.error().message, HasSubstr("use a newer flytri"));
}

TEST(CaseDamage, RefusesOtherDatabasesAndLeavesThemUnchanged) {
  const TemporaryFolder folder;
  const fs::path path = folder / "other.sqlite";
  ASSERT_TRUE(write_file(path, ""));
  {
    SqliteDatabase database = SqliteDatabase::open(path, SqliteAccess::kReadWrite).value();
    ASSERT_TRUE(database.run("CREATE TABLE bookmarks (url TEXT)"));
  }
  const std::string before = read_file(path).value();
  const Result<CaseFile> file = CaseFile::open(path);
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error().message, HasSubstr("not a flytri case"));
  EXPECT_EQ(read_file(path).value(), before);
}

TEST(CaseDamage, RefusesOtherTablesAndTriggers) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  (void)case_bytes(path);
  {
    SqliteDatabase database = SqliteDatabase::open(path, SqliteAccess::kReadWrite).value();
    ASSERT_TRUE(
        database.run("CREATE TRIGGER t AFTER INSERT ON views BEGIN DELETE FROM views; END"));
  }
  const Result<CaseFile> file = CaseFile::open(path);
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error().message, HasSubstr("tables are not those of a case"));
}

TEST(CaseDamage, RefusesFilesThatAreNotCases) {
  const TemporaryFolder folder;
  EXPECT_EQ(CaseFile::open(folder / "absent.flytri").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(CaseFile::open(folder.path()).error().code, ErrorCode::kBadFormat);
  ASSERT_TRUE(write_file(folder / "empty.flytri", ""));
  EXPECT_THAT(CaseFile::open(folder / "empty.flytri").error().message, HasSubstr("is empty"));
  ASSERT_TRUE(write_file(folder / "text.flytri", std::string(5000, 'a')));
  EXPECT_THAT(CaseFile::open(folder / "text.flytri").error().message, HasSubstr("or not a case"));
}

TEST(CaseDamage, SaysWhyACaseCannotBeCreated) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "there.flytri", "mine"));
  const Result<CaseFile> there = CaseFile::create(folder / "there.flytri", {});
  ASSERT_FALSE(there);
  EXPECT_EQ(there.error().code, ErrorCode::kBadOption);
  EXPECT_THAT(there.error().message, HasSubstr("exists already"));
  EXPECT_EQ(read_file(folder / "there.flytri").value_or(""), "mine");
  EXPECT_EQ(CaseFile::create(folder / "no" / "a.flytri", {}).error().code, ErrorCode::kNotFound);
}

TEST(CaseDamage, AfterAFullDiskNothingIsLost) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  int committed = 0;
  {
    const FullDisk limit(1U << 20U);
    Result<void> written;
    for (; committed < 1000; ++committed) {
      written = file.append_view(kDamagedStage, view_of(committed)).and_then([&] {
        return file.commit();
      });
      if (!written) break;
    }
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kWriteFailed);
    EXPECT_THAT(written.error().message, HasSubstr(path.string()));
    for (int i = 1; i < 4; ++i) {
      EXPECT_FALSE(file.append_view(kDamagedStage, view_of(committed + i)).and_then([&] {
        return file.commit();
      }));
    }
  }
  EXPECT_GT(committed, 20);
  // Nothing needs to be written again, and what came meanwhile is saved as well.
  const Result<void> again = file.append_view(kDamagedStage, view_of(committed));
  EXPECT_EQ(again.error().code, ErrorCode::kInconsistent);
  ASSERT_TRUE(file.commit());
  const StoredStage stage = file.load_stage(kDamagedStage).value();
  EXPECT_EQ(stage.views.size(), static_cast<std::size_t>(committed) + 4);
  EXPECT_TRUE(stage.damage.empty());
  EXPECT_TRUE(same_bits(*stage.views.back().view, view_of(committed + 3)));
}

TEST(CaseDamage, AfterAFullDiskAllRecordsOfAListAreSaved) {
  const TemporaryFolder folder;
  constexpr int kCount = 400;
  CaseFile file = CaseFile::create(folder / "a.flytri", {}).value();
  std::vector<AlignedView> placed;
  editing::EditStack edits;
  for (int i = 0; i < kCount; ++i) {
    placed.push_back({std::make_shared<const View>(view_of(i)), sample_pose(i)});
    edits.push(sample_edit(i));
    expect_done(file.append_view(kDamagedStage, *placed.back().view));
  }
  expect_done(file.commit());
  {
    const FullDisk limit(1);
    // More than the database keeps in memory: this fails at once, and so does each later write.
    const std::string model(std::size_t{8} << 20U, 'x');
    EXPECT_FALSE(file.write_result(kDamagedStage, {model, "{\"a\": 1}", {}}));
    EXPECT_FALSE(file.write_poses(kDamagedStage, placed));
    EXPECT_FALSE(file.write_edits(kDamagedStage, edits));
    EXPECT_TRUE(file.has_waiting());
  }
  expect_done(file.commit());
  EXPECT_FALSE(file.has_waiting());
  const StoredStage stage = file.load_stage(kDamagedStage).value();
  for (const StoredView& view : stage.views) EXPECT_TRUE(view.T_world_sensor);
  EXPECT_EQ(stage.edits.all()->size(), static_cast<std::size_t>(kCount));
  EXPECT_EQ(file.load_result(kDamagedStage).value().summary_json, "{\"a\": 1}");
}

TEST(CaseDamage, LimitsTheRecordsThatWaitForAFullDisk) {
  const TemporaryFolder folder;
  CaseOptions options;
  options.max_waiting_bytes = 1U << 20U;
  CaseFile file = CaseFile::create(folder / "a.flytri", options).value();
  std::size_t waiting = 0;
  {
    const FullDisk limit(1);
    Result<void> written;
    for (int i = 0; i < 1000; ++i) {
      written = file.append_view(kDamagedStage, sample_view(i, 2, 300));
      if (!written && written.error().code == ErrorCode::kInsufficient) break;
      ++waiting;
      (void)file.commit();
    }
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kInsufficient);
    EXPECT_THAT(written.error().message, HasSubstr("are lost"));
  }
  expect_done(file.commit());
  EXPECT_EQ(file.load_stage(kDamagedStage).value().views.size(), waiting);
}

TEST(CaseDamage, IfACaseCannotBeCreatedNoFileIsLeft) {
  const TemporaryFolder folder;
  {
    const FullDisk limit(20000);
    EXPECT_EQ(CaseFile::create(folder / "a.flytri", {}).error().code, ErrorCode::kWriteFailed);
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

/// In another process: appends views, and reports each through the pipe after its commit.
[[noreturn]] void write_until_killed(const fs::path& path, int pipe) {
  Result<CaseFile> file = CaseFile::open(path);
  if (!file) ::_exit(1);
  const int first = static_cast<int>(file->counts(kDamagedStage).value().views);
  for (std::int32_t i = first;; ++i) {
    if (!file->append_view(kDamagedStage, view_of(i)) || !file->commit()) ::_exit(1);
    if (::write(pipe, &i, sizeof(i)) != sizeof(i)) ::_exit(1);
  }
}

TEST(CaseDamage, AfterAKillAllCommitsAreThere) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  { CaseFile file = CaseFile::create(path, {}).value(); }
  Random random(14);
  std::int32_t last_committed = -1;
  for (int round = 0; round < 12; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t writer = ::fork();
    if (writer == 0) write_until_killed(path, ends[1]);
    ::close(ends[1]);
    // However slow the machine is, each writer commits at least once.
    ASSERT_GT(::read(ends[0], &last_committed, sizeof(last_committed)), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(random.below(60)));
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    for (std::int32_t i = 0; ::read(ends[0], &i, sizeof(i)) == sizeof(i);) last_committed = i;
    ::close(ends[0]);
    CaseFile file = CaseFile::open(path).value();
    EXPECT_FALSE(file.is_read_only());
    const StoredStage stage = file.load_stage(kDamagedStage).value();
    EXPECT_TRUE(stage.damage.empty());
    // The last commit may not have been reported.
    ASSERT_GE(static_cast<std::int32_t>(stage.views.size()), last_committed + 1);
    ASSERT_LE(static_cast<std::int32_t>(stage.views.size()), last_committed + 2);
    for (const StoredView& stored : stage.views) {
      ASSERT_TRUE(same_bits(*stored.view, view_of(stored.view->frame.value)));
    }
  }
}

}  // namespace
}  // namespace flytri::io
