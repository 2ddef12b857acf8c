/// @file  Cases whose pages were overwritten: what can be read comes through, also into a copy.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/random.h"
#include "core/io/cases/case_file.h"
#include "core/io/cases/view_codec.h"
#include "core/io/files/file_bytes.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::same_bits;
using testing::sample_edit;
using testing::sample_pose;
using testing::sample_texture;
using testing::sample_view;

constexpr std::size_t kPageSize = 8192;
constexpr int kScannedViews = 24;

/// Small views that share a page, and large views that fill several pages.
View scanned_view(int frame) { return sample_view(frame, 2, frame % 3 == 0 ? 300 : 10); }

void expect_success(const Result<void>& result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
}

void fill_stage(CaseFile& file, ScanStage stage) {
  for (int i = 0; i < kScannedViews; ++i) {
    const auto view = std::make_shared<const View>(scanned_view(i));
    expect_success(file.append_view(stage, *view));
    expect_success(file.write_poses(stage, std::array{AlignedView{view, sample_pose(i)}}));
    const std::array frames = {
        StoredFrame{FrameIndex(i), i / 30.0, FrameKind::kVertical, "registered", ""}};
    expect_success(file.write_frames(stage, frames));
  }
  expect_success(file.append_texture(stage, sample_texture(kScannedViews)));
  editing::EditStack edits;
  for (int i = 0; i < 4; ++i) edits.push(sample_edit(i));
  edits.undo();
  expect_success(file.write_edits(stage, edits));
  (void)file.add_measurement(stage, {0, Vec3::Zero(), Vec3::Ones(), "a"}).value();
  (void)file.add_margin(stage, testing::sample_margin()).value();
  const ResultBasis made_of = basis_of(file.counts(stage).value(), edits.state());
  expect_success(
      file.write_plane(stage, OcclusalPoints{Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9)}));
  expect_success(file.write_result(stage, {std::string(30000, 'x'), "{}", made_of}));
}

/// Writes a case with records in every table, and returns the bytes of its file.
std::string whole_case(const fs::path& path, const std::string& passphrase = {}) {
  {
    CaseFields fields;
    fields.patient_name = "Ada";
    CaseFile file =
        CaseFile::create(path, {.passphrase = Secret(passphrase)}, fields, R"({"a": 1})").value();
    fill_stage(file, ScanStage::kUpper);
    fill_stage(file, ScanStage::kBite);
    expect_success(file.commit());
  }
  return read_file(path).value();
}

void expect_same(const StoredStage& a, const StoredStage& b) {
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    EXPECT_TRUE(same_bits(*a.views[i].view, *b.views[i].view));
    ASSERT_EQ(a.views[i].T_world_sensor.has_value(), b.views[i].T_world_sensor.has_value());
    if (!a.views[i].T_world_sensor) continue;
    EXPECT_TRUE(same_bits(*a.views[i].T_world_sensor, *b.views[i].T_world_sensor));
  }
  ASSERT_EQ(a.texture_frames.size(), b.texture_frames.size());
  for (std::size_t i = 0; i < a.texture_frames.size(); ++i) {
    EXPECT_TRUE(same_bits(a.texture_frames[i], b.texture_frames[i]));
  }
  EXPECT_EQ(a.frames, b.frames);
  ASSERT_EQ(a.edits.all()->size(), b.edits.all()->size());
  for (std::size_t i = 0; i < a.edits.all()->size(); ++i) {
    EXPECT_TRUE(same_bits(*(*a.edits.all())[i], *(*b.edits.all())[i]));
  }
  EXPECT_EQ(a.edits.state()->size(), b.edits.state()->size());
  EXPECT_EQ(a.measurements.size(), b.measurements.size());
  EXPECT_EQ(a.plane, b.plane);
  EXPECT_EQ(a.margins.size(), b.margins.size());
}

/// The copy has no damage, and exactly what can be read of the damaged case.
void expect_copy_of(CaseFile& damaged, CaseFile& copy) {
  EXPECT_THAT(copy.damage(), IsEmpty());
  EXPECT_FALSE(copy.is_read_only());
  EXPECT_THAT(copy.survey().value().lost, IsEmpty());
  for (const ScanStage stage : kScanStages) {
    const StoredStage stored = copy.load_stage(stage).value();
    EXPECT_THAT(stored.damage, IsEmpty());
    expect_same(damaged.load_stage(stage).value(), stored);
    const auto model = damaged.load_result(stage);
    const auto copied = copy.load_result(stage);
    ASSERT_EQ(model.has_value(), copied.has_value())
        << (model ? copied.error() : model.error()).message;
    EXPECT_EQ(model.value_or(StageResult{}).glb, copied.value_or(StageResult{}).glb);
  }
  EXPECT_EQ(damaged.fields().value_or(CaseFields{}), copy.fields().value());
  EXPECT_EQ(damaged.calibration().value_or(""), copy.calibration().value_or(""));
}

/// A failure of a damaged case is never told as a full disk or as a device that cannot be written.
void expect_told_as_damage(const Error& error, const fs::path& path) {
  EXPECT_TRUE(error.code == ErrorCode::kBadFormat || error.code == ErrorCode::kInconsistent)
      << error.message;
  EXPECT_THAT(error.message, HasSubstr(path.string()));
  EXPECT_THAT(error.message, Not(HasSubstr("space")));
  EXPECT_THAT(error.message, Not(HasSubstr("written")));
}

struct RescueCount {
  int opened = 0;
  std::size_t views = 0, models = 0;
};

/// Opens a damaged case, copies it, and compares both.
void try_rescue(const fs::path& path, const std::string& passphrase, RescueCount& count) {
  const fs::path copy_path = path.string() + ".rescued.flytri";
  fs::remove(copy_path);
  Result<CaseFile> damaged = CaseFile::open(path, {.passphrase = Secret(passphrase)});
  if (!damaged) return expect_told_as_damage(damaged.error(), path);
  for (const ScanStage stage : kScanStages) {
    const auto counts = damaged->counts(stage);
    if (!counts) expect_told_as_damage(counts.error(), path);
  }
  const Result<CaseSurvey> survey = damaged->rescue_to(copy_path);
  ASSERT_TRUE(survey) << survey.error().message;
  EXPECT_TRUE(damaged->is_damaged() || survey->lost.empty());
  Result<CaseFile> copy = CaseFile::open(copy_path, {.passphrase = Secret(passphrase)});
  ASSERT_TRUE(copy) << copy.error().message;
  EXPECT_EQ(copy->passphrase().view(), passphrase);
  expect_copy_of(*damaged, *copy);
  ++count.opened;
  for (const StageCounts& stage : survey->readable) {
    count.views += static_cast<std::size_t>(stage.views);
    count.models += stage.has_result ? 1 : 0;
  }
}

void overwrite(const fs::path& path, const std::string& bytes) {
  for (const char* ending : {"-wal", "-shm"}) fs::remove(path.string() + ending);
  ASSERT_TRUE(write_file(path, bytes));
}

/// Puts noise over some bytes.
std::string with_noise(std::string bytes, std::size_t from, std::size_t size, Random& random) {
  for (std::size_t i = from; i < std::min(from + size, bytes.size()); ++i) {
    bytes[i] = static_cast<char>(random.next());
  }
  return bytes;
}

TEST(CaseRescue, EveryPageOverwrittenCostsWhatItHeld) {
  const TemporaryFolder folder;
  const std::string whole = whole_case(folder / "whole.flytri");
  const fs::path path = folder / "a.flytri";
  const std::size_t pages = whole.size() / kPageSize;
  ASSERT_GT(pages, 40U);
  Random random(31);
  RescueCount count;
  for (std::size_t page = 0; page < pages; ++page) {
    SCOPED_TRACE(page);
    overwrite(path, with_noise(whole, page * kPageSize, kPageSize, random));
    try_rescue(path, {}, count);
  }
  EXPECT_EQ(count.opened, static_cast<int>(pages));
  EXPECT_GT(count.views, (pages - 1) * 2 * kScannedViews * 9 / 10);
  EXPECT_GT(count.models, (pages - 1) * 2 * 8 / 10);
}

TEST(CaseRescue, AnOverwrittenStartCostsNoRecord) {
  const TemporaryFolder folder;
  const std::string whole = whole_case(folder / "whole.flytri");
  const fs::path path = folder / "a.flytri";
  Random random(34);
  for (const std::size_t size : {std::size_t{16}, std::size_t{512}, std::size_t{4096}, kPageSize}) {
    SCOPED_TRACE(size);
    overwrite(path, with_noise(whole, 0, size, random));
    RescueCount count;
    try_rescue(path, {}, count);
    EXPECT_EQ(count.views, 2U * kScannedViews);
    EXPECT_EQ(count.models, 2U);
    const CaseFile damaged = CaseFile::open(path, {.passphrase = Secret("typed")}).value();
    EXPECT_TRUE(damaged.is_read_only());
    EXPECT_THAT(damaged.damage(), Contains(HasSubstr("the start of the file was overwritten")));
    EXPECT_EQ(read_file(path).value().substr(size), whole.substr(size));
  }
}

TEST(CaseRescue, AnOverwrittenStartIsFoundBesideALog) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  (void)whole_case(path);
  CaseFile file = CaseFile::open(path).value();
  expect_success(file.append_view(ScanStage::kLower, scanned_view(0)));
  expect_success(file.commit());
  // As after a killed program: the log has what was written last.
  for (const char* ending : {"", "-wal"}) {
    fs::copy_file(path.string() + ending, (folder / "b.flytri").string() + ending);
  }
  Random random(35);
  ASSERT_TRUE(
      write_file(folder / "b.flytri", with_noise(read_file(path).value(), 0, kPageSize, random)));
  RescueCount count;
  try_rescue(folder / "b.flytri", {}, count);
  EXPECT_EQ(count.views, 2U * kScannedViews + 1);
}

TEST(CaseRescue, AnEncryptedCaseWithoutStartIsLost) {
  const TemporaryFolder folder;
  const std::string whole = whole_case(folder / "whole.flytri", "key");
  Random random(36);
  overwrite(folder / "a.flytri", with_noise(whole, 0, kPageSize, random));
  for (const char* const passphrase : {"", "key"}) {
    const auto opened = CaseFile::open(folder / "a.flytri", {.passphrase = Secret(passphrase)});
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().code, ErrorCode::kInconsistent);
  }
}

TEST(CaseRescue, OtherDatabasesAreNotTakenForCasesWithoutStart) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  const std::string whole = whole_case(path);
  constexpr std::size_t kVersionAt = 63, kApplicationAt = 68;
  for (const std::size_t at : {kVersionAt, kApplicationAt}) {
    std::string bytes = whole;
    bytes[at] = '\x77';
    overwrite(path, bytes);
    const auto opened = CaseFile::open(path);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr(at == kVersionAt ? "newer" : "not a flytri"));
  }
}

TEST(CaseRescue, SurvivesOverwrittenPartsOfAnySize) {
  const TemporaryFolder folder;
  const std::string whole = whole_case(folder / "whole.flytri");
  const fs::path path = folder / "a.flytri";
  Random random(32);
  RescueCount count;
  for (int i = 0; i < 80; ++i) {
    const std::size_t size = std::size_t{1} << random.below(17);
    std::string bytes = with_noise(whole, random.below(whole.size()), size, random);
    if (i % 3 == 0) bytes = with_noise(bytes, random.below(whole.size()), size, random);
    if (i % 7 == 0) bytes = bytes.substr(0, bytes.size() - random.below(bytes.size() / 2));
    overwrite(path, bytes);
    try_rescue(path, {}, count);
  }
  EXPECT_GT(count.opened, 40);
}

TEST(CaseRescue, TheCopyOfAnEncryptedCaseIsEncrypted) {
  const TemporaryFolder folder;
  const std::string whole = whole_case(folder / "whole.flytri", "key");
  const fs::path path = folder / "a.flytri";
  const std::size_t pages = whole.size() / kPageSize;
  Random random(33);
  RescueCount count;
  for (std::size_t page = 1; page < pages; page += 5) {
    overwrite(path, with_noise(whole, page * kPageSize + random.below(kPageSize), 64, random));
    try_rescue(path, "key", count);
    EXPECT_FALSE(CaseFile::open(path.string() + ".rescued.flytri"));
  }
  EXPECT_GT(count.opened, 8);
}

TEST(CaseRescue, ACaseWithoutPassphraseIsCopiedWithoutOneWhateverWasTyped) {
  const TemporaryFolder folder;
  (void)whole_case(folder / "a.flytri");
  CaseFile file = CaseFile::open(folder / "a.flytri", {.passphrase = Secret("typed")}).value();
  EXPECT_TRUE(file.passphrase().empty());
  EXPECT_THAT(file.rescue_to(folder / "b.flytri").value().lost, IsEmpty());
  EXPECT_TRUE(CaseFile::open(folder / "b.flytri"));
}

TEST(CaseRescue, ReplacesNoFileAndLeavesNoneOnAFullDisk) {
  const TemporaryFolder folder;
  (void)whole_case(folder / "a.flytri");
  CaseFile file = CaseFile::open(folder / "a.flytri").value();
  ASSERT_TRUE(write_file(folder / "there.flytri", "mine"));
  EXPECT_EQ(file.rescue_to(folder / "there.flytri").error().code, ErrorCode::kBadOption);
  EXPECT_EQ(read_file(folder / "there.flytri").value(), "mine");
  const FullDisk limit(200000);
  EXPECT_EQ(file.rescue_to(folder / "full.flytri").error().code, ErrorCode::kWriteFailed);
  EXPECT_FALSE(fs::exists(folder / "full.flytri"));
}

TEST(CaseRescue, AModelStaysCurrentIfViewsWereLost) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    fill_stage(file, ScanStage::kUpper);
    expect_success(file.commit());
  }
  std::string bytes = read_file(path).value();
  const std::string view = encode_view(scanned_view(3));
  const std::size_t at = bytes.find(view.substr(view.size() / 2, 40));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  overwrite(path, bytes);
  CaseFile damaged = CaseFile::open(path).value();
  const CaseSurvey survey = damaged.rescue_to(folder / "b.flytri").value();
  ASSERT_EQ(survey.readable[0].views, kScannedViews - 1);
  CaseFile copy = CaseFile::open(folder / "b.flytri").value();
  const StoredStage stage = copy.load_stage(ScanStage::kUpper).value();
  EXPECT_EQ(copy.load_result(ScanStage::kUpper)->made_of,
            basis_of(copy.counts(ScanStage::kUpper).value(), stage.edits.state()));
}

/// Overwrites all pages but the first of a case that a program has open.
void overwrite_under(const fs::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_GE(file, 0);
  const std::string noise(kPageSize, '\xaa');
  const auto size = static_cast<std::size_t>(fs::file_size(path));
  for (std::size_t at = kPageSize; at < size; at += kPageSize) {
    ASSERT_EQ(::pwrite(file, noise.data(), noise.size(), static_cast<off_t>(at)),
              static_cast<ssize_t>(noise.size()));
  }
  ::close(file);
}

TEST(CaseRescue, WhatADamagedOpenCaseDoesNotTakeGoesIntoTheCopy) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  (void)whole_case(path);
  CaseFile file = CaseFile::open(path).value();
  overwrite_under(path);
  Result<void> written;
  for (int i = 0; i < 3; ++i) {
    written = file.append_view(ScanStage::kLower, scanned_view(100 + i));
    EXPECT_FALSE(written);
  }
  EXPECT_THAT(written.error().message, HasSubstr("save a rescue copy"));
  EXPECT_THAT(written.error().message, Not(HasSubstr("space")));
  EXPECT_TRUE(file.is_damaged());
  EXPECT_TRUE(file.has_waiting());
  EXPECT_FALSE(file.commit());
  ASSERT_TRUE(file.rescue_to(folder / "b.flytri"));
  CaseFile copy = CaseFile::open(folder / "b.flytri").value();
  const StoredStage stage = copy.load_stage(ScanStage::kLower).value();
  ASSERT_EQ(stage.views.size(), 3U);
  EXPECT_TRUE(same_bits(*stage.views.back().view, scanned_view(102)));
}

}  // namespace
}  // namespace flytri::io
