#include "app/cli/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::cli {
namespace {

using ::testing::HasSubstr;

TEST(OutputFiles, AnExistingModelIsReplacedOnlyWithForce) {
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_file(folder / "jaw.glb", "glTF of another patient"));
  const auto refused = check_output_files({folder / "jaw.glb"}, {}, false);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("jaw.glb: exists already"));
  EXPECT_THAT(refused.error().message, HasSubstr("--force"));
  EXPECT_TRUE(check_output_files({folder / "jaw.glb"}, {}, true));
  EXPECT_TRUE(check_output_files({folder / "other.glb"}, {}, false));
}

TEST(OutputFiles, TheTextureBesideAModelCountsToo) {
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_file(folder / "jaw.png", "\x89PNG\r\n\x1a\n"));
  EXPECT_FALSE(check_output_files({folder / "jaw.obj"}, {}, false));
  EXPECT_TRUE(check_output_files({folder / "jaw.obj"}, {}, true));
}

TEST(OutputFiles, AFileOfAnotherKindIsNeverReplaced) {
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_file(folder / "a.flytri", "SQLite format 3"));
  ASSERT_TRUE(io::write_file(folder / "calibration.json", R"({"format": "flytri.calibration"})"));
  for (const char* name : {"a.flytri", "calibration.json"}) {
    const auto refused = check_output_files({}, {{folder / name, "flytri.report"}}, true);
    ASSERT_FALSE(refused) << name;
    EXPECT_THAT(refused.error().message, HasSubstr("not a flytri.report file"));
  }
}

TEST(OutputFiles, ARecordingIsReplacedOnlyWithForce) {
  const TemporaryFolder folder;
  EXPECT_TRUE(check_recording_folder(folder / "new", false));
  ASSERT_TRUE(io::write_file(folder / "recording.json", R"({"format": "flytri.recording"})"));
  EXPECT_FALSE(check_recording_folder(folder.path(), false));
  EXPECT_TRUE(check_recording_folder(folder.path(), true));
  ASSERT_TRUE(io::write_file(folder / "model.ply", "a letter"));
  EXPECT_FALSE(check_recording_folder(folder.path(), true));
}

}  // namespace
}  // namespace flytri::cli
