#include "core/io/calibrations/recording_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "tests/support/small_calibration.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

calibration::Calibration other_calibration() {
  calibration::Calibration other = testing::small_calibration();
  other.volume.size_mm.x() = 21.0;
  return other;
}

class RecordingCalibration : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "scan");
    recording_.folder = folder_.path() / "scan";
    recording_.calibration = "../calibration.json";
    recording_.calibration_fingerprint = fingerprint(testing::small_calibration());
    ASSERT_TRUE(write_calibration(named_, testing::small_calibration()));
    ASSERT_TRUE(write_calibration(other_, other_calibration()));
  }

  TemporaryFolder folder_;
  Recording recording_;
  const std::filesystem::path named_ = folder_.path() / "calibration.json";
  const std::filesystem::path other_ = folder_.path() / "other.json";
};

TEST_F(RecordingCalibration, IsNamedRelativeToTheRecording) {
  const auto used = calibration_of(recording_, {});
  ASSERT_TRUE(used.has_value()) << used.error().message;
  EXPECT_EQ(used->warning, "");
  EXPECT_EQ(used->calibration.volume.size_mm, testing::small_calibration().volume.size_mm);
}

TEST_F(RecordingCalibration, OfAnotherSensorIsRefused) {
  ASSERT_TRUE(write_calibration(named_, other_calibration()));
  const auto used = calibration_of(recording_, {});
  ASSERT_FALSE(used.has_value());
  EXPECT_EQ(used.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(used.error().message, HasSubstr("calibration.json"));
  EXPECT_THAT(used.error().message, HasSubstr("--calibration"));
}

TEST_F(RecordingCalibration, ThatTheUserChoosesIsUsedWithAWarning) {
  const auto other = calibration_of(recording_, other_);
  ASSERT_TRUE(other.has_value()) << other.error().message;
  EXPECT_THAT(other->warning, HasSubstr("other.json"));
  EXPECT_EQ(other->calibration.volume.size_mm.x(), 21.0);
  EXPECT_EQ(calibration_of(recording_, named_)->warning, "");
}

TEST_F(RecordingCalibration, OfAnOldRecordingIsTaken) {
  recording_.calibration_fingerprint.clear();
  for (const std::filesystem::path& chosen : {std::filesystem::path(), other_}) {
    const auto used = calibration_of(recording_, chosen);
    ASSERT_TRUE(used.has_value()) << used.error().message;
    EXPECT_EQ(used->warning, "");
  }
  recording_.calibration.reset();
  EXPECT_THAT(calibration_of(recording_, {}).error().message, HasSubstr("scan/recording.json"));
}

}  // namespace
}  // namespace flytri::io
