#include "core/io/recordings/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/files/file_bytes.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

Frame frame_of(FrameKind kind, double time_s, double value) {
  const int type = kind == FrameKind::kTexture ? CV_8UC3 : CV_16UC1;
  return {FrameIndex(0), kind, time_s, cv::Mat(6, 8, type, cv::Scalar::all(value))};
}

/// A vertical, a horizontal and a texture frame; all pixels of the texture frame are 30.
void write_three_frames(const std::filesystem::path& folder) {
  Result<RecordingWriter> writer = RecordingWriter::create(folder, "calibration.json");
  ASSERT_TRUE(writer) << writer.error().message;
  ASSERT_TRUE(writer->append(frame_of(FrameKind::kVertical, 0.0, 1000)));
  ASSERT_TRUE(writer->append(frame_of(FrameKind::kHorizontal, 1.0 / 30.0, 65535)));
  ASSERT_TRUE(writer->append(frame_of(FrameKind::kTexture, 0.1, 30)));
  ASSERT_TRUE(writer->write_list());
}

TEST(Recording, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  write_three_frames(folder / "scan");
  const Result<Recording> recording = open_recording(folder / "scan");
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->calibration, std::filesystem::path("calibration.json"));
  ASSERT_EQ(recording->frames.size(), 3U);
  EXPECT_EQ(recording->frames[1].time_s, 1.0 / 30.0);
  const Result<Frame> frame = load_frame(*recording, FrameIndex(1));
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->kind, FrameKind::kHorizontal);
  EXPECT_EQ(frame->image.at<std::uint16_t>(5, 7), 65535);
}

TEST(Recording, ADamagedFileAffectsOnlyItsFrame) {
  const TemporaryFolder folder;
  write_three_frames(folder.path());
  const std::filesystem::path damaged = folder / "frames/000001.png";
  std::filesystem::resize_file(damaged, std::filesystem::file_size(damaged) - 5);
  const Result<Recording> recording = open_recording(folder.path());
  ASSERT_TRUE(recording);
  const Result<Frame> frame = load_frame(*recording, FrameIndex(1));
  ASSERT_FALSE(frame);
  EXPECT_THAT(frame.error().message, HasSubstr("000001.png: truncated PNG"));
  EXPECT_TRUE(load_frame(*recording, FrameIndex(0)));
  EXPECT_TRUE(load_frame(*recording, FrameIndex(2)));
  std::filesystem::remove(damaged);
  EXPECT_EQ(load_frame(*recording, FrameIndex(1)).error().code, ErrorCode::kNotFound);
}

TEST(Recording, WithoutAListItIsNotARecording) {
  const TemporaryFolder folder;
  {
    Result<RecordingWriter> writer = RecordingWriter::create(folder.path());
    ASSERT_TRUE(writer->append(frame_of(FrameKind::kVertical, 0.0, 1)));
  }
  EXPECT_EQ(open_recording(folder.path()).error().code, ErrorCode::kNotFound);
}

TEST(Recording, WriterRefusesWhatTheReaderRefuses) {
  const TemporaryFolder folder;
  Result<RecordingWriter> writer = RecordingWriter::create(folder.path());
  EXPECT_EQ(writer->write_list().error().code, ErrorCode::kInsufficient);
  ASSERT_TRUE(writer->append(frame_of(FrameKind::kVertical, 1.0, 1)));
  EXPECT_FALSE(writer->append(frame_of(FrameKind::kVertical, 1.0, 1)));
  Frame color = frame_of(FrameKind::kTexture, 2.0, 1);
  color.kind = FrameKind::kUnknown;
  EXPECT_FALSE(writer->append(color));
}

struct BadText {
  const char* text;
  const char* message;
};

class BadRecording : public ::testing::TestWithParam<BadText> {};

TEST_P(BadRecording, IsRefusedWithFileAndKey) {
  const Result<Recording> recording = parse_recording(GetParam().text, "r.json");
  ASSERT_FALSE(recording);
  EXPECT_THAT(recording.error().message, HasSubstr("r.json: "));
  EXPECT_THAT(recording.error().message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Texts, BadRecording,
    ::testing::Values(
        BadText{"", "not valid JSON at line 1"}, BadText{"[]", "expected a JSON object"},
        BadText{"{\n \"version\": NaN }", "not valid JSON at line 2"},
        BadText{R"({"version":1,"frames":[]})", "\"format\": expected this key"},
        BadText{R"({"format":"flytri.recording","version":2,"frames":[]})",
                "\"version\": expected 1; this version of flytri reads no other"},
        BadText{R"({"format":"flytri.recording","version":1})", "\"frames\": expected this key"},
        BadText{R"({"format":"flytri.recording","version":1,"frames":[]})", "is empty"},
        BadText{
            R"({"format":"flytri.recording","version":1,"frames":[{"file":"a","kind":"vertical"}]})",
            "\"frames[0].time_s\": expected this key"},
        BadText{
            R"({"format":"flytri.recording","version":1,"frames":[{"file":"a","time_s":1e999,"kind":"vertical"}]})",
            "a number is out of range"},
        BadText{
            R"({"format":"flytri.recording","version":1,"frames":[{"file":"a","time_s":0,"kind":"diagonal"}]})",
            "\"frames[0].kind\": expected \"vertical\""},
        BadText{
            R"({"format":"flytri.recording","version":1,"frames":[{"file":"a","time_s":1,"kind":"texture"},{"file":"b","time_s":0,"kind":"texture"}]})",
            "\"frames[1].time_s\": expected a time after"}));

TEST(Recording, KeepsTheFingerprintOfItsCalibration) {
  const TemporaryFolder folder;
  Result<RecordingWriter> writer =
      RecordingWriter::create(folder.path(), "calibration.json", "0123456789abcdef");
  ASSERT_TRUE(writer->append(frame_of(FrameKind::kVertical, 0.0, 1)));
  ASSERT_TRUE(writer->write_list());
  EXPECT_EQ(open_recording(folder.path())->calibration_fingerprint, "0123456789abcdef");
}

TEST(Recording, AnImageOfAnotherSizeIsNotDecoded) {
  const TemporaryFolder folder;
  Result<RecordingWriter> writer = RecordingWriter::create(folder.path());
  ASSERT_TRUE(writer->append(frame_of(FrameKind::kVertical, 0.0, 1)));
  ASSERT_TRUE(writer->write_list());
  const Recording recording = open_recording(folder.path()).value();
  const cv::Mat image = load_frame(recording, FrameIndex(0))->image;
  const ImageSize size{image.cols, image.rows}, other{image.cols + 1, image.rows};
  EXPECT_TRUE(load_frame(recording, FrameIndex(0), FrameSizes{size, other}));
  // The pixels are damaged, but only the size is looked at.
  const std::filesystem::path path = folder.path() / recording.frames[0].file;
  std::string bytes = read_file(path).value();
  bytes[60] = static_cast<char>(bytes[60] + 1);
  ASSERT_TRUE(write_file(path, bytes));
  const auto refused = load_frame(recording, FrameIndex(0), FrameSizes{other, size});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(refused.error().message, HasSubstr(path.string()));
}

TEST(Recording, AMillionFramesAreRefusedAtOnce) {
  std::string text = R"({"format":"flytri.recording","version":1,"frames":[)";
  for (int i = 0; i < 1'000'000; ++i) {
    text += fmt::format(R"({}{{"file":"frames/{:06}.png","time_s":{},"kind":"vertical"}})",
                        i > 0 ? ",\n" : "", i, i);
  }
  text += "]}";
  const Result<Recording> recording = parse_recording(text, "r.json");
  ASSERT_FALSE(recording);
  EXPECT_THAT(recording.error().message, HasSubstr("r.json: \"frames\": lists more than 250000"));
}

TEST(Recording, WhatAKilledRecorderLeftIsRemovedByTheNext) {
  const TemporaryFolder folder;
  const std::filesystem::path left = folder / "frames" / ".flytri-0123abcd";
  std::filesystem::create_directory(folder / "frames");
  ASSERT_TRUE(write_file(left, "half an image"));
  ASSERT_TRUE(RecordingWriter::create(folder.path()));
  EXPECT_FALSE(std::filesystem::exists(left));
}

TEST(Recording, UnknownKeysAreIgnored) {
  const Result<Recording> recording = parse_recording(
      R"({"format":"flytri.recording","version":1,"camera":{},"frames":[{"file":"a","time_s":0,"kind":"unknown","gain":2}]})",
      "r.json");
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->frames[0].kind, FrameKind::kUnknown);
  EXPECT_FALSE(recording->calibration);
}

TEST(Recording, RealRecordingOpens) {
  const std::filesystem::path folder = testing::shared_data() / "recording-quadrant";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared recordings are missing";
  const Result<Recording> recording = open_recording(folder);
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->frames.size(), 210U);
  const Result<Frame> frame = load_frame(*recording, FrameIndex(0));
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->image.channels(), 1);
}

}  // namespace
}  // namespace flytri::io
