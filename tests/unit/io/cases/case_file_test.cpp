#include "core/io/cases/case_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/io/files/file_bytes.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::same_bits;
using testing::sample_edit;
using testing::sample_pose;
using testing::sample_texture;
using testing::sample_view;

const CaseFields kFields{"Ada Lovelace", "A-1815", "1815-12-10", "Dr. Bäbbage", "", "2026-11-21"};
constexpr ScanStage kStage = ScanStage::kLower;

/// Fails the test with the error message.
template <typename T>
void expect_done(const Result<T>& result) {
  EXPECT_TRUE(result) << result.error().message;
}

CaseFile new_case(const fs::path& path, const std::string& passphrase = {}) {
  Result<CaseFile> file = CaseFile::create(path, {Secret(passphrase), false}, kFields);
  if (!file) throw std::runtime_error(file.error().message);
  return *std::move(file);
}

CaseFile opened(const fs::path& path, const CaseOptions& options = {}) {
  Result<CaseFile> file = CaseFile::open(path, options);
  if (!file) throw std::runtime_error(file.error().message);
  return *std::move(file);
}

/// Ten small views, all but the last with poses, and a texture frame.
void fill(CaseFile& file) {
  std::vector<AlignedView> placed;
  for (int i = 0; i < 10; ++i) {
    const auto view = std::make_shared<const View>(sample_view(i, 2, 20));
    expect_done(file.append_view(kStage, *view));
    if (i < 9) placed.push_back({view, sample_pose(i)});
  }
  expect_done(file.write_poses(kStage, placed));
  expect_done(file.append_texture(kStage, sample_texture(10)));
  expect_done(file.commit());
}

StoredStage loaded(CaseFile& file, ScanStage stage = kStage) {
  Result<StoredStage> stored = file.load_stage(stage);
  expect_done(stored);
  return stored ? *std::move(stored) : StoredStage{};
}

void expect_filled(const StoredStage& stage) {
  ASSERT_EQ(stage.views.size(), 10U);
  for (int i = 0; i < 10; ++i) {
    const StoredView& stored = stage.views[static_cast<std::size_t>(i)];
    EXPECT_TRUE(same_bits(*stored.view, sample_view(i, 2, 20)));
    ASSERT_EQ(stored.T_world_sensor.has_value(), i < 9);
    if (i < 9) {
      EXPECT_TRUE(same_bits(*stored.T_world_sensor, sample_pose(i)));
    }
  }
  ASSERT_EQ(stage.texture_frames.size(), 1U);
  EXPECT_TRUE(same_bits(stage.texture_frames[0], sample_texture(10)));
  EXPECT_TRUE(stage.damage.empty());
}

TEST(CaseFile, ReadsWhatWasWrittenBitForBit) {
  const TemporaryFolder folder;
  {
    CaseFile file = new_case(folder / "a.flytri");
    fill(file);
  }
  CaseFile file = opened(folder / "a.flytri");
  EXPECT_FALSE(file.is_read_only());
  EXPECT_EQ(file.fields().value_or(CaseFields{}), kFields);
  expect_filled(loaded(file));
  EXPECT_TRUE(loaded(file, ScanStage::kUpper).views.empty());
  const StageCounts counts = file.counts(kStage).value_or(StageCounts{});
  EXPECT_EQ(counts.views, 10);
  EXPECT_EQ(counts.texture_frames, 1);
  EXPECT_FALSE(counts.has_result);
}

TEST(CaseFile, ContinuesASavedCase) {
  const TemporaryFolder folder;
  {
    CaseFile file = new_case(folder / "a.flytri");
    fill(file);
  }
  CaseFile file = opened(folder / "a.flytri");
  const auto view = std::make_shared<const View>(sample_view(11, 2, 20));
  expect_done(file.append_view(kStage, *view));
  const AlignedView moved{loaded(file).views[0].view, sample_pose(40)};
  expect_done(file.write_poses(kStage, std::array{moved, AlignedView{view, sample_pose(11)}}));
  const std::array contradicting = {FrameIndex(3)};
  expect_done(file.erase_poses(kStage, contradicting));
  const StoredStage stage = loaded(file);
  ASSERT_EQ(stage.views.size(), 11U);
  EXPECT_TRUE(same_bits(*stage.views[0].T_world_sensor, sample_pose(40)));
  EXPECT_FALSE(stage.views[3].T_world_sensor);
  EXPECT_TRUE(same_bits(*stage.views[10].T_world_sensor, sample_pose(11)));
}

TEST(CaseFile, RefusesTwoViewsOfOneFrame) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  expect_done(file.append_view(kStage, sample_view(3, 2, 20)));
  const Result<void> again = file.append_view(kStage, sample_view(3, 1, 5));
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(again.error().message, HasSubstr("views: lower 3"));
  expect_done(file.append_view(ScanStage::kBite, sample_view(3, 1, 5)));
  EXPECT_TRUE(same_bits(*loaded(file).views.at(0).view, sample_view(3, 2, 20)));
}

TEST(CaseFile, DropsWhatWasNotCommitted) {
  const TemporaryFolder folder;
  {
    CaseFile file = new_case(folder / "a.flytri");
    fill(file);
    expect_done(file.append_view(kStage, sample_view(20, 2, 20)));
  }
  CaseFile file = opened(folder / "a.flytri");
  expect_filled(loaded(file));
}

TEST(CaseFile, SavesTheFateOfEachFrame) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  const std::array frames = {
      StoredFrame{FrameIndex(0), 0.1 / 3.0, FrameKind::kVertical, "registered", ""},
      StoredFrame{FrameIndex(1), 0.2 / 3.0, FrameKind::kUnknown, "rejected", "too few points"},
      StoredFrame{FrameIndex(2), 0.3 / 3.0, FrameKind::kTexture, "", ""}};
  expect_done(file.write_frames(kStage, frames));
  EXPECT_THAT(loaded(file).frames, ::testing::ElementsAreArray(frames));
  const std::array later = {
      StoredFrame{FrameIndex(2), 0.3 / 3.0, FrameKind::kTexture, "textured", ""}};
  expect_done(file.write_frames(kStage, later));
  EXPECT_EQ(loaded(file).frames.at(2), later[0]);
}

TEST(CaseFile, SavesEditsWithUndoAndRedo) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  editing::EditStack edits;
  for (int i = 0; i < 5; ++i) edits.push(sample_edit(i));
  edits.undo();
  edits.undo();
  expect_done(file.write_edits(kStage, edits));
  editing::EditStack back = loaded(file).edits;
  ASSERT_EQ(back.state()->size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(same_bits(*(*back.state())[i], *(*edits.state())[i]));
  }
  back.redo();
  back.redo();
  EXPECT_FALSE(back.can_redo());
  EXPECT_TRUE(same_bits(*back.state()->at(4), sample_edit(4)));
  while (back.can_undo()) back.undo();
  EXPECT_TRUE(back.state()->empty());
}

TEST(CaseFile, ReplacedEditsDoNotComeBack) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  editing::EditStack edits;
  for (int i = 0; i < 3; ++i) edits.push(sample_edit(i));
  expect_done(file.write_edits(kStage, edits));
  edits.undo();
  edits.undo();
  edits.push(sample_edit(7));
  expect_done(file.write_edits(kStage, edits));
  const editing::EditStack back = loaded(file).edits;
  ASSERT_EQ(back.all()->size(), 2U);
  EXPECT_TRUE(same_bits(*back.state()->at(1), sample_edit(7)));
}

TEST(CaseFile, SavesMeasurements) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  const Measurement wanted{0, Vec3(1.0 / 3.0, -2e-17, 3), Vec3(4, 5, 0.1), "46–47, \"mesial\""};
  const auto first = file.add_measurement(kStage, wanted);
  const auto second = file.add_measurement(kStage, {0, Vec3::Zero(), Vec3::Ones(), ""});
  const auto bite = file.add_measurement(ScanStage::kBite, wanted);
  ASSERT_TRUE(first && second && bite);
  expect_done(file.remove_measurement(*second));
  const std::vector<Measurement> kept = loaded(file).measurements;
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].id, *first);
  EXPECT_EQ(kept[0].from_mm, wanted.from_mm);
  EXPECT_EQ(kept[0].to_mm, wanted.to_mm);
  EXPECT_EQ(kept[0].label, wanted.label);
  EXPECT_FALSE(file.add_measurement(kStage, {0, Vec3::Constant(NAN), Vec3::Zero(), ""}));
}

TEST(CaseFile, SavesTheOcclusalPlaneOfEachStage) {
  const TemporaryFolder folder;
  const OcclusalPoints points = {Vec3(1.0 / 3.0, -2e-17, 3), Vec3(4, 5, 0.1), Vec3(-7, 8, 9)};
  {
    CaseFile file = new_case(folder / "a.flytri");
    EXPECT_FALSE(file.plane(kStage).value());
    expect_done(file.write_plane(kStage, points));
    expect_done(file.write_plane(ScanStage::kUpper, OcclusalPoints()));
    expect_done(file.write_plane(ScanStage::kUpper, std::nullopt));
    expect_done(file.write_result(kStage, {"glb", R"({"views": 1})", {}}));
    expect_done(file.commit());
  }
  CaseFile file = CaseFile::open(folder / "a.flytri", {}).value();
  EXPECT_EQ(file.plane(kStage).value(), points);
  EXPECT_EQ(loaded(file).plane, points);
  EXPECT_THAT(loaded(file).damage, ::testing::IsEmpty());
  EXPECT_FALSE(file.plane(ScanStage::kUpper).value());
  EXPECT_FALSE(file.plane(ScanStage::kBite).value());
  EXPECT_EQ(file.load_result(kStage)->glb, "glb") << "beside it";
  OcclusalPoints wrong = points;
  wrong[1].x() = NAN;
  EXPECT_FALSE(file.write_plane(kStage, wrong));
}

TEST(CaseFile, SavesMarginLines) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.flytri";
  StoredMargin wanted = testing::sample_margin();
  std::int64_t first = 0;
  {
    CaseFile file = new_case(path);
    expect_done(file.write_result(kStage, {"glb", "{}"}));
    first = file.add_margin(kStage, testing::sample_margin(5)).value();
    const auto second = file.add_margin(kStage, testing::sample_margin(6));
    ASSERT_TRUE(second && file.add_margin(ScanStage::kBite, wanted));
    expect_done(file.remove_margin(*second));
    wanted.id = first;
    expect_done(file.replace_margin(wanted));
    expect_done(file.commit());
  }
  CaseFile file = opened(path);
  const std::vector<StoredMargin> kept = loaded(file).margins;
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].id, first);
  EXPECT_EQ(kept[0].clicks_mm, wanted.clicks_mm);
  EXPECT_TRUE(kept[0].margin.line.is_closed);
  ASSERT_EQ(kept[0].margin.line.points.size(), wanted.margin.line.points.size());
  for (std::size_t i = 0; i < wanted.margin.line.points.size(); ++i) {
    EXPECT_EQ(kept[0].margin.line.points[i].position_mm, wanted.margin.line.points[i].position_mm);
    EXPECT_EQ(kept[0].margin.line.points[i].sigma_mm, wanted.margin.line.points[i].sigma_mm);
  }
  EXPECT_EQ(kept[0].margin.edge_share, wanted.margin.edge_share);
  EXPECT_EQ(kept[0].margin.least_turn_rad, wanted.margin.least_turn_rad);
  EXPECT_EQ(file.load_margins(kStage).value().size(), 1U);
  EXPECT_EQ(file.load_result(kStage).value_or(StageResult{}).summary_json, "{}");

  StoredMargin bad = wanted;
  bad.clicks_mm.pop_back();
  EXPECT_EQ(file.add_margin(kStage, bad).error().code, ErrorCode::kBadOption);
  bad = wanted;
  bad.margin.line.points[0].position_mm.x() = NAN;
  EXPECT_EQ(file.replace_margin(bad).error().code, ErrorCode::kBadOption);
}

TEST(CaseFile, SavesCalibrationAndModel) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  EXPECT_EQ(file.calibration().error().code, ErrorCode::kInsufficient);
  EXPECT_EQ(file.load_result(kStage).error().code, ErrorCode::kInsufficient);
  expect_done(file.write_calibration("{\"a\": 1}"));
  const std::string glb("glTF\0\x02 and so on", 16);
  expect_done(file.write_result(kStage, {"first", ""}));
  expect_done(file.write_result(kStage, {glb, "{}"}));
  EXPECT_EQ(file.calibration().value_or(""), "{\"a\": 1}");
  EXPECT_EQ(file.load_result(kStage).value_or(StageResult{}).glb, glb);
  EXPECT_EQ(file.load_result(kStage).value_or(StageResult{}).summary_json, "{}");
  EXPECT_TRUE(file.counts(kStage).value_or(StageCounts{}).has_result);
}

TEST(CaseFile, AnEmptyRecordIsNotDamaged) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  expect_done(file.write_calibration(""));
  expect_done(file.commit());
  EXPECT_EQ(file.calibration().value_or("none"), "");
  EXPECT_FALSE(file.is_damaged());
}

TEST(CaseFile, AModelSaysWhatItWasMadeOf) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  const ResultBasis basis{17, {0.5, 1.0 / 3.0}};
  expect_done(file.write_result(kStage, {"glb", R"({"views": 3})", basis}));
  const StageResult result = file.load_result(kStage).value_or(StageResult{});
  EXPECT_EQ(result.made_of, basis);
  EXPECT_THAT(result.summary_json, HasSubstr("\"views\":3"));
  expect_done(file.write_result(kStage, {"glb", R"({"made_of": {"view_count": -1}})", {}}));
  EXPECT_FALSE(file.load_result(kStage).value_or(StageResult{}).made_of);
}

TEST(CaseFile, AStageCanBeCleared) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  fill(file);
  expect_done(file.append_view(ScanStage::kUpper, sample_view(3, 2, 20)));
  expect_done(file.clear_stage(kStage));
  EXPECT_TRUE(loaded(file).views.empty());
  EXPECT_EQ(loaded(file, ScanStage::kUpper).views.size(), 1U);
  EXPECT_EQ(file.fields().value_or(CaseFields{}), kFields);
}

/// The bytes of all files in the folder.
std::string all_bytes(const fs::path& folder) {
  std::string bytes;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    bytes += read_file(entry.path()).value_or("");
  }
  return bytes;
}

TEST(CaseFile, EncryptsEverythingWithThePassphrase) {
  const TemporaryFolder plain, encrypted;
  {
    CaseFile a = new_case(plain / "a.flytri");
    CaseFile b = new_case(encrypted / "b.flytri", "o∴p&'\"");
    fill(a);
    fill(b);
    EXPECT_THAT(all_bytes(plain.path()), HasSubstr(kFields.patient_name));
    EXPECT_THAT(all_bytes(encrypted.path()), Not(HasSubstr(kFields.patient_name)));
    // Three bytes would be there by chance once in fifty runs.
    constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n";
    EXPECT_NE(all_bytes(plain.path()).find(kPng), std::string::npos);
    EXPECT_EQ(all_bytes(encrypted.path()).find(kPng), std::string::npos);
  }
  EXPECT_THAT(all_bytes(encrypted.path()), Not(HasSubstr(kFields.patient_name)));
  CaseFile file = opened(encrypted / "b.flytri", {Secret("o∴p&'\""), true});
  expect_filled(loaded(file));
}

TEST(CaseFile, ReportsAMissingOrWrongPassphrase) {
  const TemporaryFolder folder;
  { CaseFile file = new_case(folder / "a.flytri", "right"); }
  const Result<CaseFile> without = CaseFile::open(folder / "a.flytri");
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(without.error().message, HasSubstr("give its passphrase"));
  const Result<CaseFile> wrong = CaseFile::open(folder / "a.flytri", {Secret("wrong"), false});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(wrong.error().message, HasSubstr("passphrase is wrong"));
  EXPECT_TRUE(CaseFile::open(folder / "a.flytri", {Secret("right"), false}));
}

TEST(CaseFile, OnlyItsOwnerMayReadIt) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  fill(file);
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) {
    EXPECT_EQ(entry.status().permissions(), fs::perms::owner_read | fs::perms::owner_write)
        << entry.path();
    ++count;
  }
  EXPECT_EQ(count, 2) << "the case and its log";
}

TEST(CaseFile, LeavesNoOtherFile) {
  const TemporaryFolder folder;
  {
    CaseFile file = new_case(folder / "a.flytri");
    fill(file);
  }
  { CaseFile file = opened(folder / "a.flytri", {{}, true}); }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(CaseFile, OnlyOneProgramAtATimeMayWrite) {
  const TemporaryFolder folder;
  CaseFile file = new_case(folder / "a.flytri");
  for (const bool read_only : {false, true}) {
    const Result<CaseFile> second = CaseFile::open(folder / "a.flytri", {{}, read_only});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kNotPermitted);
    EXPECT_THAT(second.error().message, HasSubstr("open in another program"));
  }
}

TEST(CaseFile, ReadOnlyChangesNothing) {
  const TemporaryFolder folder;
  {
    CaseFile file = new_case(folder / "a.flytri");
    fill(file);
  }
  const std::string before = all_bytes(folder.path());
  CaseFile file = opened(folder / "a.flytri", {{}, true});
  EXPECT_TRUE(file.is_read_only());
  expect_filled(loaded(file));
  const Result<void> written = file.append_view(kStage, sample_view(30));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kNotPermitted);
  EXPECT_EQ(all_bytes(folder.path()), before);
}

TEST(CaseFile, MovesIntoAnEncryptedFile) {
  const TemporaryFolder folder;
  const fs::path from = folder.path() / "from.flytri", to = folder.path() / "to.flytri";
  CaseFile file = new_case(from);
  fill(file);
  expect_done(file.move_to(to, {Secret("secret")}));
  EXPECT_EQ(file.path(), to);
  EXPECT_FALSE(fs::exists(from));
  // It goes on there.
  expect_done(file.append_view(kStage, sample_view(11, 2, 20)));
  expect_done(file.commit());
  file = new_case(folder.path() / "other.flytri");
  EXPECT_FALSE(CaseFile::open(to)) << "encrypted";
  CaseFile moved = opened(to, {Secret("secret")});
  const StoredStage stage = loaded(moved);
  EXPECT_EQ(stage.views.size(), 11U);
  EXPECT_TRUE(same_bits(*stage.views[3].view, sample_view(3, 2, 20)));
  EXPECT_EQ(stage.texture_frames.size(), 1U);
  EXPECT_EQ(moved.fields().value(), kFields);
}

TEST(CaseFile, StaysWhereItIsIfItCannotBeMoved) {
  const TemporaryFolder folder;
  const fs::path from = folder.path() / "from.flytri", taken = folder.path() / "taken.flytri";
  CaseFile file = new_case(from);
  fill(file);
  expect_done(write_file(taken, "somebody's"));
  EXPECT_FALSE(file.move_to(taken, {}));
  EXPECT_EQ(read_file(taken).value(), "somebody's");
  {
    const FullDisk disk(20'000);
    EXPECT_FALSE(file.move_to(folder.path() / "full.flytri", {}));
  }
  EXPECT_FALSE(fs::exists(folder.path() / "full.flytri"));
  EXPECT_EQ(file.path(), from);
  EXPECT_EQ(loaded(file).views.size(), 10U);
}

}  // namespace
}  // namespace flytri::io
