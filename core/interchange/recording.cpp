#include "core/interchange/recording.h"

#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/interchange/file_bytes.h"
#include "core/interchange/frame_kind.h"
#include "core/interchange/json_place.h"
#include "core/interchange/png.h"

namespace flytri {
namespace {

constexpr const char* kRecordingFile = "recording.json";
constexpr std::string_view kRecordingFormat = "flytri.recording";
constexpr int kRecordingVersion = 1;

bool type_fits(FrameKind kind, int type) {
  if (kind == FrameKind::kTexture) return type == CV_8UC3;
  return type == CV_8UC1 || type == CV_16UC1;
}

std::string_view expected_type(FrameKind kind) {
  return kind == FrameKind::kTexture ? "8-bit RGB" : "8- or 16-bit grey";
}

}  // namespace

Result<Recording> parse_recording(std::string_view text, const std::string& name) {
  const Result<JsonPlace> json = JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kRecordingFormat, kRecordingVersion);
  Recording recording;
  if (json->has("calibration")) recording.calibration = json->at("calibration").text();
  for (const JsonPlace& place : json->at("frames").elements()) {
    RecordedFrame frame{place.at("file").text(), place.at("time_s").number(),
                        read_frame_kind(place.at("kind"))};
    if (!recording.frames.empty() && frame.time_s <= recording.frames.back().time_s) {
      place.at("time_s").reject("a time after that of the frame before");
    }
    recording.frames.push_back(std::move(frame));
  }
  if (Result<void> outcome = json->outcome(); !outcome) return tl::unexpected(outcome.error());
  if (recording.frames.empty()) {
    return fail(ErrorCode::kInsufficient, "{}: \"frames\": the recording is empty; record again",
                name);
  }
  return recording;
}

Result<Recording> open_recording(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kRecordingFile;
  Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<Recording> recording = parse_recording(*text, path.string());
  if (!recording) return recording;
  recording->folder = folder;
  return recording;
}

Result<Frame> load_frame(const Recording& recording, FrameIndex index) {
  const RecordedFrame& recorded = recording.frames.at(index.at());
  const std::filesystem::path path = recording.folder / recorded.file;
  Result<cv::Mat> image = read_png(path);
  if (!image) return tl::unexpected(image.error());
  if (!type_fits(recorded.kind, image->type())) {
    return fail(ErrorCode::kBadFormat, "{}: a frame of kind \"{}\" must be {}", path.string(),
                to_string(recorded.kind), expected_type(recorded.kind));
  }
  return Frame{index, recorded.kind, recorded.time_s, *std::move(image)};
}

RecordingWriter::RecordingWriter(std::filesystem::path folder, std::string calibration)
    : folder_(std::move(folder)), calibration_(std::move(calibration)) {}

Result<RecordingWriter> RecordingWriter::create(const std::filesystem::path& folder,
                                                std::string calibration) {
  if (Result<void> made = create_folder(folder / "frames"); !made) {
    return tl::unexpected(made.error());
  }
  // From the first overwritten image on, the old list would be a lie.
  std::error_code error;
  std::filesystem::remove(folder / kRecordingFile, error);
  if (error) {
    return fail(ErrorCode::kNotPermitted, "{}: cannot be replaced: {}",
                (folder / kRecordingFile).string(), error.message());
  }
  return RecordingWriter(folder, std::move(calibration));
}

Result<void> RecordingWriter::append(const Frame& frame) {
  if (!type_fits(frame.kind, frame.image.type())) {
    return fail(ErrorCode::kBadOption, "{}: a frame of kind \"{}\" must be {}", folder_.string(),
                to_string(frame.kind), expected_type(frame.kind));
  }
  if (!std::isfinite(frame.time_s) || (!frames_.empty() && frame.time_s <= frames_.back().time_s)) {
    return fail(ErrorCode::kBadOption, "{}: frame {} is not later than the one before",
                folder_.string(), frames_.size());
  }
  std::string file = fmt::format("frames/{:06}.png", frames_.size());
  if (Result<void> written = write_png(folder_ / file, frame.image); !written) return written;
  frames_.push_back({std::move(file), frame.time_s, frame.kind});
  return {};
}

Result<void> RecordingWriter::close() {
  if (frames_.empty()) {
    return fail(ErrorCode::kInsufficient, "{}: no frame was recorded", folder_.string());
  }
  nlohmann::ordered_json json = {{"format", kRecordingFormat}, {"version", kRecordingVersion}};
  if (!calibration_.empty()) json["calibration"] = calibration_;
  for (const RecordedFrame& frame : frames_) {
    json["frames"].push_back(
        {{"file", frame.file}, {"time_s", frame.time_s}, {"kind", to_string(frame.kind)}});
  }
  return write_file(folder_ / kRecordingFile, json.dump(1) + "\n");
}

}  // namespace flytri
