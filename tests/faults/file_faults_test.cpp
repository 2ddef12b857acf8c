/// @file  Files that are written while system calls fail or the program is killed: each is the
/// former one or the new one, whole.
#include <gtest/gtest.h>

#include <array>

#include "app/session/settings_file.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"
#include "core/io/recordings/recording.h"
#include "tests/faults/fault_injector.h"
#include "tests/support/colored_sphere.h"
#include "tests/support/small_calibration.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using testing::expect_withstands_faults;
using testing::RunEnd;

class FileFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = testing::why_no_faults(); !why.empty()) GTEST_SKIP() << why;
  }
};

std::string bytes_of(const fs::path& path) { return read_file(path).value_or("cannot be read"); }

/// The former file if the work failed, the new one if not. It may also be new when only its folder
/// could not be flushed.
void expect_whole(const fs::path& path, const std::string& former, const std::string& renewed,
                  const RunEnd& end) {
  const std::string bytes = bytes_of(path);
  EXPECT_TRUE(bytes == renewed || (bytes == former && !end.is_done))
      << path << ", " << bytes.size();
}

TEST_F(FileFaults, AFileIsReplacedOrStays) {
  const std::string former = "former", renewed(100'000, 'n');
  expect_withstands_faults(
      {[&](const fs::path& folder) { ASSERT_TRUE(write_file(folder / "a.txt", former)); },
       [&](const fs::path& folder) { return write_file(folder / "a.txt", renewed); },
       [&](const fs::path& folder, const RunEnd& end) {
         expect_whole(folder / "a.txt", former, renewed, end);
       }});
}

/// The files of a model in all formats, by name.
using ModelFiles = std::map<std::string, std::string>;

Result<void> write_all_formats(const fs::path& folder, const TexturedMesh& model) {
  for (const ModelFormat& format : model_formats()) {
    const fs::path path = folder / ("jaw" + std::string(format.extension));
    if (auto written = write_model(path, model); !written) return written;
  }
  return {};
}

ModelFiles files_in(const fs::path& folder) {
  ModelFiles files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = bytes_of(entry.path());
  }
  return files;
}

ModelFiles files_of(const TexturedMesh& model) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_all_formats(folder.path(), model));
  return files_in(folder.path());
}

TEST_F(FileFaults, ModelsInAllFormatsAreReplacedOrStay) {
  TexturedMesh former = textured_sphere(), renewed = textured_sphere();
  former.atlas.setTo(cv::Scalar(1, 2, 3));
  for (auto& vertex : former.mesh.vertices) vertex.position_mm *= 2.0F;
  const ModelFiles former_files = files_of(former), new_files = files_of(renewed);
  expect_withstands_faults(
      {[&](const fs::path& folder) { ASSERT_TRUE(write_all_formats(folder, former)); },
       [&](const fs::path& folder) { return write_all_formats(folder, renewed); },
       [&](const fs::path& folder, const RunEnd& end) {
         for (const auto& [name, bytes] : new_files) {
           expect_whole(folder / name, former_files.at(name), bytes, end);
         }
         if (end.is_killed) return;
         // All files of one model, or none.
         const bool is_new = bytes_of(folder / "jaw.obj") == new_files.at("jaw.obj");
         EXPECT_EQ(bytes_of(folder / "jaw.png") == new_files.at("jaw.png"), is_new);
       }});
}

TEST_F(FileFaults, ACalibrationIsReplacedOrStays) {
  const calibration::Calibration former = testing::small_calibration();
  calibration::Calibration renewed = former;
  renewed.volume.size_mm.x() += 0.5;
  expect_withstands_faults(
      {[&](const fs::path& folder) { ASSERT_TRUE(write_calibration(folder / "c.json", former)); },
       [&](const fs::path& folder) { return write_calibration(folder / "c.json", renewed); },
       [&](const fs::path& folder, const RunEnd& end) {
         expect_whole(folder / "c.json", to_json(former), to_json(renewed), end);
       }});
}

TEST_F(FileFaults, SettingsAreReplacedOrStay) {
  ui::Settings former, renewed;
  former.user_scale = 1.25;
  renewed.is_muted = true;
  expect_withstands_faults(
      {[&](const fs::path& folder) {
         ASSERT_TRUE(session::write_settings(folder / "flytri" / "settings.json", former));
       },
       [&](const fs::path& folder) {
         return session::write_settings(folder / "flytri" / "settings.json", renewed);
       },
       [&](const fs::path& folder, const RunEnd& end) {
         const ui::Settings found = session::read_settings(folder / "flytri" / "settings.json");
         EXPECT_TRUE(found == renewed || (found == former && !end.is_done));
       }});
}

Frame recorded_frame(int number) {
  const cv::Mat image(48, 64, CV_8UC1, cv::Scalar(10.0 * number));
  return {FrameIndex(number), FrameKind::kVertical, number / 30.0, image};
}

constexpr int kRecordedFrames = 4;

Result<void> record(const fs::path& folder) {
  Result<RecordingWriter> writer = RecordingWriter::create(folder / "scan");
  if (!writer) return tl::unexpected(writer.error());
  for (int i = 0; i < kRecordedFrames; ++i) {
    if (auto appended = writer->append(recorded_frame(i)); !appended) return appended;
    if (auto listed = writer->write_list(); !listed) return listed;
  }
  return {};
}

TEST_F(FileFaults, ARecordingHasAllFramesThatItLists) {
  expect_withstands_faults(
      {[](const fs::path&) {}, record,
       [](const fs::path& folder, const RunEnd& end) {
         const auto recording = open_recording(folder / "scan");
         EXPECT_TRUE(recording || !end.is_done);
         if (!recording) return;
         const auto count = static_cast<int>(recording->frames.size());
         EXPECT_TRUE(!end.is_done || count == kRecordedFrames);
         for (int i = 0; i < count; ++i) {
           const auto frame = load_frame(*recording, FrameIndex(i));
           ASSERT_TRUE(frame) << frame.error().message;
           EXPECT_EQ(cv::norm(frame->image, recorded_frame(i).image, cv::NORM_INF), 0.0);
         }
       }});
}

}  // namespace
}  // namespace flytri::io
