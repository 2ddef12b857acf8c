#include "app/session/calibration_files.h"

#include <gmock/gmock.h>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/calibrations/guided_session_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/rig/rig_file.h"
#include "hw/shots/simulated_shots.h"
#include "tests/support/small_calibration.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

rig::RigSettings small_rig() {
  rig::RigSettings rig;
  rig.measurement.match.name = "Mono";
  rig.lights.chip.label = "ftdi-cbus";
  rig.lights.vertical.name = "CBUS0";
  rig.lights.horizontal.name = "CBUS1";
  return rig;
}

std::vector<fs::path> files_like(const fs::path& folder, const std::string& words) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().find(words) != std::string::npos) {
      found.push_back(entry.path());
    }
  }
  return found;
}

TEST(CalibrationFiles, ProposesAnUnfinishedCalibration) {
  const TemporaryFolder folder;
  const fs::path fresh = propose_calibration_folder(folder.path());
  EXPECT_FALSE(fs::exists(fresh));
  const fs::path begun = folder.path() / "2031-01-01-080000";
  ASSERT_TRUE(io::write_guided_plan(begun, shots::plan_of(simulated::intraoral_sensor())));
  EXPECT_EQ(propose_calibration_folder(folder.path()), begun);
  ASSERT_TRUE(io::write_file(begun / "calibration.json", "{}"));
  EXPECT_NE(propose_calibration_folder(folder.path()), begun);
}

TEST(CalibrationFiles, NamesTheFirstCalibrationInTheRig) {
  const TemporaryFolder folder;
  const fs::path made = folder.path() / "made.json", rig = folder.path() / "rig.json";
  ASSERT_TRUE(io::write_file(made, "new"));
  ASSERT_TRUE(rig::write_rig(rig, small_rig()));
  SourceChoice choice;
  choice.name = kRigSource;
  choice.path = rig;
  const auto adopted = adopt_calibration(choice, made);
  ASSERT_TRUE(adopted.has_value()) << adopted.error().message;
  EXPECT_EQ(*adopted, folder.path() / "calibration.json");
  EXPECT_EQ(*rig::read_rig(rig)->calibration, folder.path() / "calibration.json");
  EXPECT_EQ(io::read_file(*adopted).value(), "new");
}

TEST(CalibrationFiles, KeepsTheFormerCalibration) {
  const TemporaryFolder folder;
  const fs::path made = folder.path() / "made.json", named = folder.path() / "named.json";
  ASSERT_TRUE(io::write_file(made, "new"));
  ASSERT_TRUE(io::write_file(named, "old"));
  SourceChoice choice;
  choice.name = kRigSource;
  choice.path = folder.path() / "rig.json";
  choice.calibration = named;
  ASSERT_TRUE(adopt_calibration(choice, made).has_value());
  EXPECT_EQ(io::read_file(named).value(), "new");
  const auto kept = files_like(folder.path(), "named-until-");
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(io::read_file(kept.front()).value(), "old");
}

TEST(CalibrationFiles, LeavesADamagedRigFileUnchanged) {
  const TemporaryFolder folder;
  const fs::path made = folder.path() / "made.json", rig = folder.path() / "rig.json";
  ASSERT_TRUE(io::write_file(made, "new"));
  ASSERT_TRUE(io::write_file(rig, "{"));
  SourceChoice choice;
  choice.name = kRigSource;
  choice.path = rig;
  EXPECT_FALSE(adopt_calibration(choice, made).has_value());
  EXPECT_EQ(io::read_file(rig).value(), "{");
  EXPECT_FALSE(fs::exists(folder.path() / "calibration.json"));
}

/// The file of a calibration.
class NotedCheck : public ::testing::Test {
 protected:
  void SetUp() override {
    made_.history.made_at = "2031-01-01T08:00:00Z";
    ASSERT_TRUE(io::write_calibration(file_, made_));
  }
  Result<void> note(const calibration::Calibration& checked) {
    return note_check(file_, checked, checked_now(checked.history, false));
  }

  calibration::Calibration made_ = testing::small_calibration();
  TemporaryFolder folder_;
  fs::path file_ = folder_ / "calibration.json";
};

TEST_F(NotedCheck, IsInTheHistoryOfTheCalibration) {
  ASSERT_TRUE(note(made_));
  const auto kept = io::read_calibration(file_).value();
  EXPECT_EQ(kept.history.made_at, made_.history.made_at);
  EXPECT_FALSE(kept.history.checked_at.empty());
  EXPECT_FALSE(kept.history.has_passed);
  EXPECT_EQ(io::fingerprint(kept), io::fingerprint(made_));
}

TEST_F(NotedCheck, AReadOnlyFileStaysAsItIs) {
  const std::string before = io::read_file(file_).value();
  fs::permissions(file_, fs::perms::owner_read);
  const auto noted = note(made_);
  ASSERT_FALSE(noted);
  EXPECT_THAT(noted.error().message, ::testing::HasSubstr("calibration.json: is read-only"));
  EXPECT_EQ(io::read_file(file_).value(), before);
}

TEST_F(NotedCheck, AnotherCalibrationStaysAsItIs) {
  calibration::Calibration other = made_;
  other.volume.size_mm.z() = 14.0;
  EXPECT_EQ(note(other).error().code, ErrorCode::kInconsistent);
  EXPECT_TRUE(io::read_calibration(file_)->history.checked_at.empty());
}

}  // namespace
}  // namespace flytri::session
