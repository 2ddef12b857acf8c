/// @file  The truth beside a recording of the pictures of a scan, as flytri evaluate reads it.
#pragma once

#include <filesystem>
#include <vector>

#include "core/imaging/frame.h"
#include "tests/hardware/scan/scan_pictures.h"

namespace flytri::scan {

/// Which picture a frame of the recording shows.
struct Shown {
  std::size_t number = 0;  ///< of the moment
  FrameKind kind = FrameKind::kVertical;
  bool operator==(const Shown&) const = default;
};

/// Writes truth.json and the mesh, with what of it was lit, beside the recording.
/// @param shown  by frame of the recording
/// @errors  As open_recording, write_truth and write_ply.
[[nodiscard]] Result<void> write_scan_truth(const std::filesystem::path& recording,
                                            const ScanPictures& pictures,
                                            const simulated::SensorModel& sensor,
                                            const std::vector<Shown>& shown,
                                            const Workers& workers);

}  // namespace flytri::scan
