/// @file  Recordings on disk: a folder's list of frames, and each frame when it is wanted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/imaging/frame.h"

namespace flytri::io {

/// One line of recording.json.
struct RecordedFrame {
  std::string file;     ///< relative to the folder
  double time_s = 0.0;  ///< middle of the exposure
  FrameKind kind = FrameKind::kUnknown;
};

/// A recording's list of frames; no image is loaded.
struct Recording {
  std::filesystem::path folder;
  std::optional<std::filesystem::path>
      calibration;                    ///< path of the file, if the recording names one
  std::vector<RecordedFrame> frames;  ///< at least one, by rising time
};

/// Parses the text of recording.json, see docs/formats.md.
/// @param name  of the file, for messages
/// @errors  kBadFormat (the key and what was expected), kInsufficient (no frames).
[[nodiscard]] Result<Recording> parse_recording(std::string_view text, const std::string& name);

/// @param folder  the one that holds recording.json
/// @errors  As read_file and parse_recording.
[[nodiscard]] Result<Recording> open_recording(const std::filesystem::path& folder);

/// Loads one frame. A file that is missing or damaged costs that frame alone: go on with the next.
/// @errors  As read_png; kBadFormat: color where grey is expected or the reverse.
[[nodiscard]] Result<Frame> load_frame(const Recording& recording, FrameIndex index);

/// Writes a recording frame by frame. The folder becomes a recording at write_list(), which writes
/// recording.json with the frames that are complete: when stopped early, list what there is.
/// Destroyed without write_list(), it leaves images, but nothing that would be taken for a
/// recording; destroyed without a frame, it leaves nothing.
class RecordingWriter {
 public:
  /// Creates the folder. A recording that lies there already is given up with the first frame.
  /// @param calibration  what recording.json is to name: relative to the folder; empty: nothing
  /// @errors  As create_folder.
  [[nodiscard]] static Result<RecordingWriter> create(const std::filesystem::path& folder,
                                                      std::string calibration = {});
  /// Saves a frame under the next number; `frame.index` plays no part. The image is written
  /// without waiting for the disk.
  /// @errors  kBadOption (image type does not fit the kind, time not rising), as
  ///          encode_camera_png and AtomicFile.
  [[nodiscard]] Result<void> append(const Frame& frame);
  /// Waits until the disk has all images, then lists them. May be called over and over.
  /// @errors  As sync_file and write_file; kInsufficient: no frame was appended.
  [[nodiscard]] Result<void> write_list();

  /// The frames that are complete, as they will be listed.
  [[nodiscard]] const std::vector<RecordedFrame>& frames() const { return frames_; }

 private:
  /// Folders that were made, removed again if nothing was put into them.
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
  RecordingWriter(std::filesystem::path folder, std::string calibration, MadeFolders made);

  std::filesystem::path folder_;
  std::string calibration_;
  MadeFolders made_;
  std::vector<RecordedFrame> frames_;
  std::size_t synced_ = 0;  // so many frames are on the disk
  std::string lines_;       // of the list
};

}  // namespace flytri::io
