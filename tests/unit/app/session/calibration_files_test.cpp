#include "app/session/calibration_files.h"

#include <gmock/gmock.h>

#include "core/io/calibrations/guided_session_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/rig/rig_file.h"
#include "hw/shots/simulated_shots.h"
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

}  // namespace
}  // namespace flytri::session
