/// @file  Reads and writes recordings: a folder with a list of frames and an image for each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/imaging/frame.h"

namespace flytri::io {

/// A frame in the list of recording.json.
struct RecordedFrame {
  std::string file;     ///< relative to the folder
  double time_s = 0.0;  ///< middle of the exposure
  FrameKind kind = FrameKind::kUnknown;
};

/// The list of frames; the images stay on the disk.
struct Recording {
  std::filesystem::path folder;
  /// Path of the file as the recording names it, if it does; see calibration_of().
  std::optional<std::filesystem::path> calibration;
  std::string calibration_fingerprint;  ///< of the calibration it was made with; empty: unknown
  std::vector<RecordedFrame> frames;    ///< at least one, in order of time
};

/// Parses the text of recording.json, see docs/formats.md.
/// @param name  of the file, for messages
/// @errors  kBadFormat (the key and what was expected; more than 250,000 frames), kInsufficient (no
///          frames).
[[nodiscard]] Result<Recording> parse_recording(std::string_view text, const std::string& name);

/// @param folder  contains recording.json
/// @errors  As read_file and parse_recording.
[[nodiscard]] Result<Recording> open_recording(const std::filesystem::path& folder);

/// The image sizes that a calibration is for.
struct FrameSizes {
  ImageSize measurement, texture;
};

/// Loads one frame. If its file is missing or damaged, the other frames can still be loaded.
/// @param sizes  an image of another size is not decoded
/// @errors  As read_png; kBadFormat: color instead of grey, or grey instead of color;
/// kInconsistent:
///          another size.
[[nodiscard]] Result<Frame> load_frame(const Recording& recording, FrameIndex index,
                                       const std::optional<FrameSizes>& sizes = std::nullopt);

/// Writes a recording frame by frame. write_list() makes the folder a recording: it writes
/// recording.json with the frames so far, also when the recording stopped early. Without
/// write_list(), images are left but no recording.json; without a frame, nothing is left.
class RecordingWriter {
 public:
  /// Creates the folder. The first frame replaces a recording that is already there.
  /// @param calibration  path for recording.json, relative to the folder; empty: none
  /// @param fingerprint  of the calibration; empty: unknown
  /// @errors  As create_folder.
  [[nodiscard]] static Result<RecordingWriter> create(const std::filesystem::path& folder,
                                                      std::string calibration = {},
                                                      std::string fingerprint = {});
  /// Saves a frame under the next number; `frame.index` is ignored. Does not wait for the disk.
  /// @errors  kBadOption (wrong image type for the kind, time not after the last frame),
  ///          kInsufficient (it has as many frames as can be read again), as encode_camera_png and
  ///          AtomicFile.
  [[nodiscard]] Result<void> append(const Frame& frame);
  /// Waits until the disk has all images, then lists them. May be called again after more frames.
  /// @errors  As sync_file and write_file; kInsufficient: no frame was appended.
  [[nodiscard]] Result<void> write_list();

  /// The complete frames, as write_list() will list them.
  [[nodiscard]] const std::vector<RecordedFrame>& frames() const { return frames_; }

 private:
  /// Folders that the writer created; removes them again if they are empty.
  class MadeFolders {
   public:
    explicit MadeFolders(std::vector<std::filesystem::path> folders)
        : folders_(std::move(folders)) {}
    MadeFolders(MadeFolders&&) = default;
    MadeFolders& operator=(MadeFolders&&) = default;
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    ~MadeFolders();

   private:
    std::vector<std::filesystem::path> folders_;  // inner ones first
  };
  RecordingWriter(std::filesystem::path folder, std::string calibration, std::string fingerprint,
                  MadeFolders made);

  std::filesystem::path folder_;
  std::string calibration_, fingerprint_;
  MadeFolders made_;
  std::vector<RecordedFrame> frames_;
  std::size_t synced_ = 0;  // number of frames that are certainly on the disk
  std::string lines_;       // the list, as JSON
};

}  // namespace flytri::io
