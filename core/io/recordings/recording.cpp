#include "core/io/recordings/recording.h"

#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/io/files/atomic_file.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"
#include "core/io/files/leftovers.h"
#include "core/io/files/png.h"
#include "core/io/recordings/frame_kind.h"

namespace flytri::io {
namespace {

constexpr const char* kRecordingFile = "recording.json";
constexpr std::string_view kRecordingFormat = "flytri.recording";
constexpr int kRecordingVersion = 1;
constexpr const char* kImageFolder = "frames";
constexpr const char* kFingerprintKey = "calibration_fingerprint";
/// More than two hours of one camera at 30 Hz, and the list that names so many frames.
constexpr std::size_t kMaxFrames = 250'000, kMaxListBytes = std::size_t{32} << 20U;

bool type_fits(FrameKind kind, int type) {
  if (kind == FrameKind::kTexture) return type == CV_8UC3;
  return type == CV_8UC1 || type == CV_16UC1;
}

std::string_view expected_type(FrameKind kind) {
  return kind == FrameKind::kTexture ? "8-bit RGB" : "8- or 16-bit grey";
}

/// Compares the size that the header of an image states.
Result<void> check_size(std::string_view png, const std::string& name, const ImageSize& wanted) {
  const std::optional<ImageSize> size = stated_png_size(png);
  if (!size || *size == wanted) return {};
  return fail(ErrorCode::kInconsistent,
              "{}: {} x {} pixels, but the calibration is for {} x {}; use the calibration of this "
              "sensor",
              name, size->width_px, size->height_px, wanted.width_px, wanted.height_px);
}

tl::unexpected<Error> too_long(const std::string& name) {
  return fail(ErrorCode::kBadFormat,
              "{}: \"frames\": lists more than {} frames, the most that one recording can have; "
              "divide it into shorter ones",
              name, kMaxFrames);
}

/// The folders that create_folder would create for this path; inner ones first.
std::vector<std::filesystem::path> missing_folders(std::filesystem::path path) {
  std::vector<std::filesystem::path> missing;
  std::error_code unknown;
  for (; !path.empty() && !std::filesystem::exists(path, unknown); path = path.parent_path())
    missing.push_back(path);
  return missing;
}

/// Removes the list of a former recording before its first image is overwritten: it would be wrong.
Result<void> remove_list(const std::filesystem::path& list) {
  std::error_code error;
  std::filesystem::remove(list, error);
  if (!error) return {};
  return fail(ErrorCode::kNotPermitted, "{}: cannot be replaced: {}; choose another folder",
              list.string(), error.message());
}

Result<void> write_image(const std::filesystem::path& path, const cv::Mat& image) {
  const Result<std::string> bytes = encode_camera_png(image);
  if (!bytes) return tl::unexpected(bytes.error());
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  if (Result<void> written = file->write(*bytes); !written) return written;
  return file->commit_unsynced();
}

}  // namespace

Result<Recording> parse_recording(std::string_view text, const std::string& name) {
  if (text.size() > kMaxListBytes) return too_long(name);
  const Result<JsonPlace> json = JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kRecordingFormat, kRecordingVersion);
  Recording recording;
  if (json->has("calibration")) recording.calibration = json->at("calibration").text();
  if (json->has(kFingerprintKey))
    recording.calibration_fingerprint = json->at(kFingerprintKey).text();
  const std::vector<JsonPlace> frames = json->at("frames").elements();
  if (frames.size() > kMaxFrames) return too_long(name);
  for (const JsonPlace& place : frames) {
    if (!json->outcome()) break;
    RecordedFrame frame{place.at("file").text(), place.at("time_s").number(),
                        read_frame_kind(place.at("kind"))};
    if (!recording.frames.empty() && frame.time_s <= recording.frames.back().time_s) {
      place.at("time_s").reject("a time after the frame before");
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
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > kMaxListBytes) return too_long(path.string());
  Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<Recording> recording = parse_recording(*text, path.string());
  if (!recording) return recording;
  recording->folder = folder;
  return recording;
}

Result<Frame> load_frame(const Recording& recording, FrameIndex index,
                         const std::optional<FrameSizes>& sizes) {
  const RecordedFrame& recorded = recording.frames.at(index.at());
  const std::filesystem::path path = recording.folder / recorded.file;
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  if (sizes) {
    const bool is_texture = recorded.kind == FrameKind::kTexture;
    const Result<void> fits =
        check_size(*bytes, path.string(), is_texture ? sizes->texture : sizes->measurement);
    if (!fits) return tl::unexpected(fits.error());
  }
  Result<cv::Mat> image = decode_png(*bytes, path.string());
  if (!image) return tl::unexpected(image.error());
  if (!type_fits(recorded.kind, image->type())) {
    return fail(ErrorCode::kBadFormat,
                "{}: a frame of kind \"{}\" must be {}; record again, or correct \"kind\"",
                path.string(), to_string(recorded.kind), expected_type(recorded.kind));
  }
  return Frame{index, recorded.kind, recorded.time_s, *std::move(image)};
}

RecordingWriter::MadeFolders::~MadeFolders() {
  std::error_code not_empty;
  for (const std::filesystem::path& folder : folders_) std::filesystem::remove(folder, not_empty);
}

RecordingWriter::RecordingWriter(std::filesystem::path folder, std::string calibration,
                                 std::string fingerprint, MadeFolders made)
    : folder_(std::move(folder)),
      calibration_(std::move(calibration)),
      fingerprint_(std::move(fingerprint)),
      made_(std::move(made)) {}

Result<RecordingWriter> RecordingWriter::create(const std::filesystem::path& folder,
                                                std::string calibration, std::string fingerprint) {
  const std::filesystem::path images = folder / kImageFolder;
  MadeFolders made(missing_folders(images));
  if (Result<void> created = create_folder(images); !created) {
    return tl::unexpected(created.error());
  }
  for (const auto& written : {folder, images}) remove_leftovers(written);
  return RecordingWriter(folder, std::move(calibration), std::move(fingerprint), std::move(made));
}

Result<void> RecordingWriter::append(const Frame& frame) {
  if (!type_fits(frame.kind, frame.image.type())) {
    return fail(ErrorCode::kBadOption, "{}: a frame of kind \"{}\" must be {}", folder_.string(),
                to_string(frame.kind), expected_type(frame.kind));
  }
  if (!std::isfinite(frame.time_s) || (!frames_.empty() && frame.time_s <= frames_.back().time_s)) {
    return fail(ErrorCode::kBadOption, "{}: frame {} is not later than the frame before",
                folder_.string(), frames_.size());
  }
  if (frames_.size() == kMaxFrames) {
    return fail(ErrorCode::kInsufficient,
                "{}: a recording has at most {} frames; begin another one", folder_.string(),
                kMaxFrames);
  }
  if (frames_.empty()) {
    if (Result<void> removed = remove_list(folder_ / kRecordingFile); !removed) return removed;
  }
  std::string file = fmt::format("{}/{:06}.png", kImageFolder, frames_.size());
  if (Result<void> written = write_image(folder_ / file, frame.image); !written) return written;
  lines_ += frames_.empty() ? "\n  " : ",\n  ";
  lines_ += nlohmann::ordered_json(
                {{"file", file}, {"time_s", frame.time_s}, {"kind", to_string(frame.kind)}})
                .dump();
  frames_.push_back({std::move(file), frame.time_s, frame.kind});
  return {};
}

Result<void> RecordingWriter::write_list() {
  if (frames_.empty()) {
    return fail(ErrorCode::kInsufficient,
                "{}: no frame was recorded; check the source and record again", folder_.string());
  }
  for (; synced_ < frames_.size(); ++synced_) {
    if (Result<void> synced = sync_file(folder_ / frames_[synced_].file); !synced) return synced;
  }
  const auto quoted = [](std::string_view text) { return nlohmann::json(text).dump(); };
  std::string text = fmt::format("{{\n \"format\": {},\n \"version\": {},\n",
                                 quoted(kRecordingFormat), kRecordingVersion);
  if (!calibration_.empty()) text += fmt::format(" \"calibration\": {},\n", quoted(calibration_));
  if (!fingerprint_.empty())
    text += fmt::format(" {}: {},\n", quoted(kFingerprintKey), quoted(fingerprint_));
  text += fmt::format(" \"frames\": [{}\n ]\n}}\n", lines_);
  return write_file(folder_ / kRecordingFile, text);
}

}  // namespace flytri::io
