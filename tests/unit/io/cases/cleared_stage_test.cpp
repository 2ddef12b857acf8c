/// @file  Stages that are cleared, and what comes back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/base/random.h"
#include "core/io/cases/case_file.h"
#include "core/io/files/file_bytes.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using testing::same_bits;
using testing::sample_edit;
using testing::sample_pose;
using testing::sample_texture;
using testing::sample_view;

constexpr ScanStage kClearedStage = ScanStage::kLower;

/// Of a scan that begins with this frame.
OcclusalPoints plane_of(int first) { return {Vec3(first, 1, 2), Vec3(3, 4, 5), Vec3(6, 7, 8)}; }

/// A scan of some views, with a texture frame, an edit, a distance and a model named after it.
void scan(CaseFile& file, int first, int count, const std::string& name) {
  ASSERT_TRUE(testing::append_registered_views(file, kClearedStage, first, count));
  ASSERT_TRUE(file.append_texture(kClearedStage, sample_texture(first + count)));
  editing::EditStack edits;
  edits.push(sample_edit(first));
  ASSERT_TRUE(file.write_edits(kClearedStage, edits));
  ASSERT_TRUE(file.add_measurement(kClearedStage, {0, Vec3::Zero(), Vec3::Ones(), name}));
  ASSERT_TRUE(file.write_result(kClearedStage, {name, "{}", {}}));
  ASSERT_TRUE(file.write_plane(kClearedStage, plane_of(first)));
  ASSERT_TRUE(file.add_margin(kClearedStage, testing::sample_margin(first + count)));
  ASSERT_TRUE(file.commit());
}

/// The stage shows exactly this scan.
void expect_shown(CaseFile& file, int first, int count, const std::string& name) {
  const StoredStage stage = file.load_stage(kClearedStage).value();
  EXPECT_THAT(stage.damage, IsEmpty());
  ASSERT_EQ(stage.views.size(), static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const StoredView& stored = stage.views[static_cast<std::size_t>(i)];
    EXPECT_TRUE(same_bits(*stored.view, sample_view(first + i, 2, 20)));
    ASSERT_TRUE(stored.T_world_sensor);
    EXPECT_TRUE(same_bits(*stored.T_world_sensor, sample_pose(first + i)));
  }
  EXPECT_EQ(stage.frames.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(stage.texture_frames.size(), 1U);
  ASSERT_EQ(stage.edits.state()->size(), 1U);
  EXPECT_TRUE(same_bits(*stage.edits.state()->front(), sample_edit(first)));
  ASSERT_EQ(stage.measurements.size(), 1U);
  EXPECT_EQ(stage.measurements.front().label, name);
  ASSERT_EQ(stage.margins.size(), 1U);
  EXPECT_EQ(stage.margins.front().margin.line.points.size(),
            static_cast<std::size_t>(first + count));
  EXPECT_EQ(file.load_result(kClearedStage).value().glb, name);
  EXPECT_EQ(stage.plane, plane_of(first));
  EXPECT_EQ(file.counts(kClearedStage).value(), (StageCounts{count, 1, 1, true}));
}

void expect_empty(CaseFile& file) {
  const StoredStage stage = file.load_stage(kClearedStage).value();
  EXPECT_THAT(stage.views, IsEmpty());
  EXPECT_THAT(stage.frames, IsEmpty());
  EXPECT_THAT(stage.texture_frames, IsEmpty());
  EXPECT_TRUE(stage.edits.all()->empty());
  EXPECT_THAT(stage.measurements, IsEmpty());
  EXPECT_FALSE(stage.plane);
  EXPECT_THAT(stage.margins, IsEmpty());
  EXPECT_FALSE(file.load_result(kClearedStage));
  EXPECT_EQ(file.counts(kClearedStage).value(), StageCounts{});
}

void commit(CaseFile& file, const Result<void>& change) {
  ASSERT_TRUE(change) << change.error().message;
  ASSERT_TRUE(file.commit());
}

TEST(ClearedStage, IsEmptyAndComesBackAlsoAfterReopening) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    scan(file, 0, 5, "first");
    ASSERT_TRUE(file.append_view(ScanStage::kUpper, sample_view(0, 2, 20)));
    commit(file, file.clear_stage(kClearedStage));
    expect_empty(file);
    EXPECT_EQ(file.load_stage(kClearedStage)->last_frame, FrameIndex(5))
        << "new frames come after those that are kept";
  }
  CaseFile file = CaseFile::open(path).value();
  expect_empty(file);
  EXPECT_EQ(file.kept_counts(kClearedStage).value(), (StageCounts{5, 1, 1, true}));
  EXPECT_EQ(file.counts(ScanStage::kUpper)->views, 1);
  EXPECT_EQ(file.kept_counts(ScanStage::kUpper).value(), StageCounts{});
  commit(file, file.bring_back_stage(kClearedStage));
  expect_shown(file, 0, 5, "first");
  EXPECT_EQ(file.kept_counts(kClearedStage).value(), StageCounts{});
}

TEST(ClearedStage, ASecondScanAndTheFirstCanBeSwapped) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  scan(file, 0, 5, "first");
  commit(file, file.clear_stage(kClearedStage));
  scan(file, 10, 3, "second");
  expect_shown(file, 10, 3, "second");
  commit(file, file.bring_back_stage(kClearedStage));
  expect_shown(file, 0, 5, "first");
  // The first goes on: its frames lie on both sides of the second's.
  const auto view = std::make_shared<const View>(sample_view(20, 2, 20));
  ASSERT_TRUE(file.append_view(kClearedStage, *view));
  commit(file, file.bring_back_stage(kClearedStage));
  expect_shown(file, 10, 3, "second");
  commit(file, file.bring_back_stage(kClearedStage));
  EXPECT_EQ(file.load_stage(kClearedStage)->views.size(), 6U);
}

TEST(ClearedStage, ClearingOnceMoreErasesWhatWasKept) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  scan(file, 0, 5, "first");
  commit(file, file.clear_stage(kClearedStage));
  commit(file, file.clear_stage(kClearedStage));
  EXPECT_EQ(file.kept_counts(kClearedStage)->views, 5) << "to clear what is empty does nothing";
  scan(file, 10, 3, "second");
  commit(file, file.clear_stage(kClearedStage));
  expect_empty(file);
  EXPECT_EQ(file.kept_counts(kClearedStage)->views, 3);
  commit(file, file.bring_back_stage(kClearedStage));
  expect_shown(file, 10, 3, "second");
  EXPECT_EQ(file.bring_back_stage(kClearedStage).error().code, ErrorCode::kInsufficient);
}

TEST(ClearedStage, TheRescueCopyKeepsBothScans) {
  const TemporaryFolder folder;
  CaseFile file = CaseFile::create(folder / "a.flytri", {}).value();
  scan(file, 0, 5, "first");
  commit(file, file.clear_stage(kClearedStage));
  scan(file, 10, 3, "second");
  const CaseSurvey survey = file.rescue_to(folder / "b.flytri").value();
  EXPECT_THAT(survey.lost, IsEmpty());
  EXPECT_EQ(survey.readable[1].views, 3);
  CaseFile copy = CaseFile::open(folder / "b.flytri").value();
  expect_shown(copy, 10, 3, "second");
  commit(copy, copy.bring_back_stage(kClearedStage));
  expect_shown(copy, 0, 5, "first");
}

TEST(ClearedStage, OnAFullDiskClearingWaitsOrFailsAsAWhole) {
  const TemporaryFolder folder;
  CaseFile file = CaseFile::create(folder / "a.flytri", {}).value();
  scan(file, 0, 5, "first");
  {
    const FullDisk limit(1);
    const Result<void> cleared = file.clear_stage(kClearedStage);
    EXPECT_FALSE(cleared && file.commit());
    EXPECT_TRUE(file.has_waiting());
  }
  ASSERT_TRUE(file.commit());
  expect_empty(file);
  commit(file, file.bring_back_stage(kClearedStage));
  expect_shown(file, 0, 5, "first");
}

/// In another process: clears the stage and brings the scan back, again and again.
[[noreturn]] void clear_until_killed(const fs::path& path, int pipe) {
  Result<CaseFile> file = CaseFile::open(path);
  if (!file) ::_exit(1);
  for (;;) {
    if (!file->clear_stage(kClearedStage) || !file->commit()) ::_exit(1);
    if (::write(pipe, "c", 1) != 1) ::_exit(1);
    if (!file->bring_back_stage(kClearedStage) || !file->commit()) ::_exit(1);
  }
}

TEST(ClearedStage, AfterAKillTheStageIsAsBeforeOrCleared) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    scan(file, 0, 5, "first");
  }
  Random random(41);
  for (int round = 0; round < 12; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t writer = ::fork();
    if (writer == 0) clear_until_killed(path, ends[1]);
    ::close(ends[1]);
    char cleared = 0;
    ASSERT_GT(::read(ends[0], &cleared, 1), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(random.below(30)));
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    ::close(ends[0]);
    CaseFile file = CaseFile::open(path).value();
    EXPECT_FALSE(file.is_damaged());
    if (file.counts(kClearedStage)->views == 0) {
      expect_empty(file);
      commit(file, file.bring_back_stage(kClearedStage));
    }
    expect_shown(file, 0, 5, "first");
  }
}

}  // namespace
}  // namespace flytri::io
