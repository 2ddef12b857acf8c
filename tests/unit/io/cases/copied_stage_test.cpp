/// @file  Stages that start as copies of another scan of the same jaw.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/io/cases/case_file.h"
#include "core/io/files/file_bytes.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::same_bits;
using testing::sample_edit;
using testing::sample_pose;
using testing::sample_texture;
using testing::sample_view;

constexpr ScanStage kSource = ScanStage::kUpper, kTarget = ScanStage::kUpperPreop;
constexpr int kCopiedViews = 6;

/// Views with poses and fates, a texture frame, an edit that applies and one that was undone, a
/// distance and a model.
void scan(CaseFile& file, ScanStage stage, int first) {
  ASSERT_TRUE(testing::append_registered_views(file, stage, first, kCopiedViews));
  ASSERT_TRUE(file.append_texture(stage, sample_texture(first + kCopiedViews)));
  editing::EditStack edits;
  edits.push(sample_edit(first));
  edits.push(sample_edit(first + 1));
  edits.undo();
  ASSERT_TRUE(file.write_edits(stage, edits));
  ASSERT_TRUE(file.add_measurement(stage, {0, Vec3::Zero(), Vec3::Ones(), "a"}));
  const ResultBasis basis{kCopiedViews, {sample_edit(first).made_at_s}};
  ASSERT_TRUE(file.write_result(stage, {"model", "{}", basis}));
  ASSERT_TRUE(file.commit());
}

/// The stage holds this scan. @param shift  of its frame numbers
void expect_scan(CaseFile& file, ScanStage stage, int first, int shift, bool has_model) {
  const StoredStage stored = file.load_stage(stage).value();
  EXPECT_THAT(stored.damage, IsEmpty());
  ASSERT_EQ(stored.views.size(), static_cast<std::size_t>(kCopiedViews));
  for (int i = 0; i < kCopiedViews; ++i) {
    const StoredView& view = stored.views[static_cast<std::size_t>(i)];
    View expected = sample_view(first + i, 2, 20);
    expected.frame = FrameIndex(first + i + shift);
    EXPECT_TRUE(same_bits(*view.view, expected));
    ASSERT_TRUE(view.T_world_sensor);
    EXPECT_TRUE(same_bits(*view.T_world_sensor, sample_pose(first + i)));
  }
  EXPECT_EQ(stored.frames.size(), static_cast<std::size_t>(kCopiedViews));
  EXPECT_EQ(stored.texture_frames.size(), 1U);
  ASSERT_EQ(stored.edits.state()->size(), 1U);
  EXPECT_TRUE(same_bits(*stored.edits.state()->front(), sample_edit(first)));
  EXPECT_TRUE(stored.edits.can_redo());
  EXPECT_EQ(stored.measurements.size(), 1U);
  EXPECT_EQ(file.counts(stage).value(), (StageCounts{kCopiedViews, 1, 1, has_model}));
  if (!has_model) return;
  const StageResult result = file.load_result(stage).value();
  EXPECT_EQ(result.glb, "model");
  EXPECT_EQ(result.made_of, basis_of(file.counts(stage).value(), stored.edits.state()))
      << "the model is that of the copy, too";
}

TEST(CopiedStage, HasAllOfTheOtherWhichStaysAsItIs) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    scan(file, kSource, 3);
    ASSERT_TRUE(file.copy_stage(kSource, kTarget, true));
    ASSERT_TRUE(file.copy_stage(kSource, ScanStage::kUpperScanBody, false));
  }
  CaseFile file = CaseFile::open(path).value();
  expect_scan(file, kSource, 3, 0, true);
  expect_scan(file, kTarget, 3, 0, true);
  expect_scan(file, ScanStage::kUpperScanBody, 3, 0, false);
  EXPECT_EQ(file.counts(ScanStage::kLower).value(), StageCounts{});
}

TEST(CopiedStage, GoesOnByItself) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  scan(file, kSource, 0);
  ASSERT_TRUE(file.copy_stage(kSource, kTarget, false));
  editing::EditStack edits = file.load_stage(kTarget)->edits;
  edits.push(sample_edit(9));
  ASSERT_TRUE(file.write_edits(kTarget, edits));
  ASSERT_TRUE(file.append_view(kTarget, sample_view(20, 2, 20)));
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(file.counts(kTarget)->views, kCopiedViews + 1);
  EXPECT_EQ(file.load_stage(kTarget)->edits.state()->size(), 2U);
  expect_scan(file, kSource, 0, 0, true);
  ASSERT_TRUE(file.clear_stage(kTarget));
  ASSERT_TRUE(file.commit());
  expect_scan(file, kSource, 0, 0, true);
}

TEST(CopiedStage, KeepsWhatWasClearedInIt) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  scan(file, kTarget, 100);
  ASSERT_TRUE(file.clear_stage(kTarget));
  scan(file, kSource, 3);
  ASSERT_TRUE(file.copy_stage(kSource, kTarget, true));
  const int shift = 100 + kCopiedViews + 1;  // after the frames that are kept
  expect_scan(file, kTarget, 3, shift, true);
  EXPECT_EQ(file.kept_counts(kTarget)->views, kCopiedViews);
  ASSERT_TRUE(file.bring_back_stage(kTarget));
  ASSERT_TRUE(file.commit());
  expect_scan(file, kTarget, 100, 0, true);
  ASSERT_TRUE(file.bring_back_stage(kTarget));
  expect_scan(file, kTarget, 3, shift, true);
}

TEST(CopiedStage, OfAScanThatWasSwapped) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  scan(file, kSource, 0);
  ASSERT_TRUE(file.clear_stage(kSource));
  scan(file, kSource, 50);
  ASSERT_TRUE(file.copy_stage(kSource, kTarget, true));
  expect_scan(file, kTarget, 50, 0, true);
  ASSERT_TRUE(file.bring_back_stage(kSource));
  ASSERT_TRUE(file.copy_stage(kSource, ScanStage::kUpperScanBody, true));
  expect_scan(file, ScanStage::kUpperScanBody, 0, 0, true);
}

TEST(CopiedStage, RefusesWhatMakesNoSense) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  const auto refusal = [&](ScanStage from, ScanStage to) {
    const Result<void> copied = file.copy_stage(from, to, false);
    return copied ? std::string("done") : copied.error().message;
  };
  EXPECT_THAT(refusal(kSource, kTarget), HasSubstr("stage upper has no views to copy"));
  scan(file, kSource, 0);
  EXPECT_THAT(refusal(kSource, kSource), HasSubstr("cannot start as a copy of upper"));
  EXPECT_THAT(refusal(kSource, ScanStage::kLowerPreop), HasSubstr("stage lower-preop cannot"));
  EXPECT_THAT(refusal(kSource, ScanStage::kBite), HasSubstr("stage bite cannot"));
  EXPECT_THAT(refusal(ScanStage::kBite, ScanStage::kBite2), HasSubstr("cannot"));
  ASSERT_TRUE(file.append_view(kTarget, sample_view(0, 2, 20)));
  EXPECT_THAT(refusal(kSource, kTarget), HasSubstr("stage upper-preop is not empty; clear it"));
  EXPECT_EQ(file.counts(kTarget)->views, 1);
}

TEST(CopiedStage, AFullDiskLeavesNoHalfCopy) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  CaseFile file = CaseFile::create(path, {}).value();
  scan(file, kSource, 0);
  int failures = 0;
  for (rlim_t size = 8192;; size += size / 4) {
    Result<void> copied;
    {
      const FullDisk limit(size);
      copied = file.copy_stage(kSource, kTarget, true);
    }
    if (copied) break;
    ++failures;
    ASSERT_FALSE(file.is_damaged()) << copied.error().message;
    ASSERT_EQ(file.counts(kTarget).value(), StageCounts{});
    ASSERT_FALSE(file.has_waiting()) << "nobody waits for the rest of it";
  }
  EXPECT_GT(failures, 2);
  expect_scan(file, kTarget, 0, 0, true);
  expect_scan(file, kSource, 0, 0, true);
}

/// At any moment.
TEST(CopiedStage, AKilledProgramLeavesAllOrNothing) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    scan(file, kSource, 0);
  }
  const std::string before = read_file(path).value();
  int empty = 0, whole = 0;
  for (int microseconds = 0; microseconds < 60'000; microseconds += 1'500) {
    remove_case(path);
    ASSERT_TRUE(write_file(path, before));
    const pid_t child = ::fork();
    if (child == 0) {
      auto file = CaseFile::open(path);
      ::_exit(file && file->copy_stage(kSource, kTarget, true) ? 0 : 1);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    CaseFile file = CaseFile::open(path).value();
    const StageCounts counts = file.counts(kTarget).value();
    if (counts == StageCounts{}) {
      ++empty;
    } else {
      ++whole;
      expect_scan(file, kTarget, 0, 0, true);
    }
    expect_scan(file, kSource, 0, 0, true);
  }
  EXPECT_GT(empty, 0);
  EXPECT_GT(whole, 0);
}

TEST(CopiedStage, ADamagedSourceIsNotCopiedInPart) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    scan(file, kSource, 0);
  }
  ASSERT_EQ(testing::run_sql(path, "UPDATE views SET checksum = checksum + 1 WHERE id % 2 = 1"),
            "");
  CaseFile file = CaseFile::open(path).value();
  const Result<void> copied = file.copy_stage(kSource, kTarget, true);
  ASSERT_FALSE(copied);
  EXPECT_EQ(copied.error().code, ErrorCode::kBadFormat);
  EXPECT_THAT(copied.error().message, HasSubstr("views: upper"));
  EXPECT_EQ(file.counts(kTarget).value(), StageCounts{});
}

}  // namespace
}  // namespace flytri::io
