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

/// A rig whose sensor gets a new calibration.
class NewCalibration : public ::testing::Test {
 protected:
  void SetUp() override {
    choice_.name = kRigSource;
    choice_.path = folder_ / "rig.json";
    ASSERT_TRUE(rig::write_rig(choice_.path, small_rig()));
    former_.volume.size_mm.z() = 16.0;
    former_.history.checks = {{"2031-02-01T08:00:00Z", false, "19 °C"}};
    next_.history.note = "22 °C";
    ASSERT_TRUE(io::write_calibration(made_, next_));
  }
  Result<fs::path> adopt() { return adopt_calibration(choice_, made_); }
  fs::path kept() const {
    const auto kept = files_like(folder_.path(), "calibration-until-");
    EXPECT_EQ(kept.size(), 1U);
    return kept.empty() ? fs::path() : kept.front();
  }

  TemporaryFolder folder_;
  fs::path made_ = folder_ / "made.json", in_use_ = folder_ / "calibration.json";
  SourceChoice choice_;
  calibration::Calibration former_ = testing::small_calibration(), next_ = former_;
};

TEST_F(NewCalibration, IsNamedInTheRigIfItIsTheFirst) {
  const auto adopted = adopt();
  ASSERT_TRUE(adopted.has_value()) << adopted.error().message;
  EXPECT_EQ(*adopted, in_use_);
  EXPECT_EQ(*rig::read_rig(choice_.path)->calibration, in_use_);
  EXPECT_EQ(io::read_file(in_use_).value(), io::read_file(made_).value());
}

TEST_F(NewCalibration, KeepsTheFormerOneAndItsHistory) {
  ASSERT_TRUE(io::write_calibration(in_use_, former_));
  ASSERT_TRUE(adopt().has_value());
  const auto used = io::read_calibration(in_use_).value();
  EXPECT_EQ(io::fingerprint(used), io::fingerprint(next_));
  EXPECT_EQ(used.history.note, "22 °C");
  EXPECT_TRUE(used.history.checks.empty());
  ASSERT_EQ(used.history.past.size(), 1U);
  EXPECT_EQ(used.history.past[0].checks[0].note, "19 °C");
  EXPECT_EQ(used.history.past[0].kept_in, kept().filename());
  EXPECT_EQ(io::fingerprint(io::read_calibration(kept()).value()), io::fingerprint(former_));
}

TEST_F(NewCalibration, ThatIsInUseAlreadyKeepsItsChecks) {
  calibration::Calibration checked = next_;
  checked.history.checks.push_back(checked_now(true, ""));
  ASSERT_TRUE(io::write_calibration(in_use_, checked));
  ASSERT_TRUE(adopt().has_value());
  EXPECT_EQ(io::read_calibration(in_use_)->history.checks.size(), 1U);
  EXPECT_TRUE(files_like(folder_.path(), "-until-").empty());
}

TEST_F(NewCalibration, ReplacesADamagedFileThatIsKept) {
  ASSERT_TRUE(io::write_file(in_use_, "old"));
  ASSERT_TRUE(adopt().has_value());
  EXPECT_TRUE(io::read_calibration(in_use_)->history.past.empty());
  EXPECT_EQ(io::read_file(kept()).value(), "old");
}

TEST_F(NewCalibration, ThatIsDamagedIsNotTakenIntoUse) {
  ASSERT_TRUE(io::write_calibration(in_use_, former_));
  ASSERT_TRUE(io::write_file(made_, "{"));
  EXPECT_FALSE(adopt().has_value());
  EXPECT_EQ(io::fingerprint(io::read_calibration(in_use_).value()), io::fingerprint(former_));
}

TEST_F(NewCalibration, LeavesADamagedRigFileUnchanged) {
  ASSERT_TRUE(io::write_file(choice_.path, "{"));
  EXPECT_FALSE(adopt().has_value());
  EXPECT_EQ(io::read_file(choice_.path).value(), "{");
  EXPECT_FALSE(fs::exists(in_use_));
}

/// The file of a calibration.
class NotedCheck : public ::testing::Test {
 protected:
  void SetUp() override {
    made_.history.made_at = "2031-01-01T08:00:00Z";
    ASSERT_TRUE(io::write_calibration(file_, made_));
  }
  Result<void> note(const calibration::Calibration& checked) {
    return note_check(file_, checked, checked_now(false, "22 °C"));
  }

  calibration::Calibration made_ = testing::small_calibration();
  TemporaryFolder folder_;
  fs::path file_ = folder_ / "calibration.json";
};

TEST_F(NotedCheck, IsInTheHistoryOfTheCalibration) {
  ASSERT_TRUE(note(made_));
  const auto kept = io::read_calibration(file_).value();
  EXPECT_EQ(kept.history.made_at, made_.history.made_at);
  ASSERT_EQ(kept.history.checks.size(), 1U);
  EXPECT_FALSE(kept.history.checks[0].at.empty());
  EXPECT_FALSE(kept.history.checks[0].has_passed);
  EXPECT_EQ(kept.history.checks[0].note, "22 °C");
  EXPECT_EQ(io::fingerprint(kept), io::fingerprint(made_));
}

TEST_F(NotedCheck, ComesAfterThatOfAnotherProgramMeanwhile) {
  calibration::Calibration meanwhile = made_;
  meanwhile.history.checks = {{"2031-02-01T08:00:00Z", true, "in another window"}};
  ASSERT_TRUE(io::write_calibration(file_, meanwhile));
  ASSERT_TRUE(note(made_));
  const auto kept = io::read_calibration(file_).value();
  ASSERT_EQ(kept.history.checks.size(), 2U);
  EXPECT_EQ(kept.history.checks[0].note, "in another window");
  EXPECT_EQ(kept.history.checks[1].note, "22 °C");
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
  EXPECT_TRUE(io::read_calibration(file_)->history.checks.empty());
}

}  // namespace
}  // namespace flytri::session
