/// @file  Writes the truth of a recorded scan for flytri evaluate.
#pragma once

#include <filesystem>
#include <vector>

#include "core/imaging/frame.h"
#include "tests/hardware/scan/scan_pictures.h"

namespace flytri::scan {

/// The picture that a recorded frame shows.
struct Shown {
  std::size_t number = 0;  ///< number of the moment
  FrameKind kind = FrameKind::kVertical;
  bool operator==(const Shown&) const = default;
};

/// The virtual machine is slow: gives the frames of its recording the times of the real hand, since
/// the reconstruction judges gaps by the speed.
/// @param keeps_calibration  whether the recording goes on naming its calibration
/// @errors  As read_file and write_file.
[[nodiscard]] Result<void> set_pace(const std::filesystem::path& recording, double pace,
                                    bool keeps_calibration = true);

/// Writes truth.json and the mesh, with its lit places, to the recording.
/// @param shown  for each frame of the recording
/// @errors  As open_recording, write_truth and write_ply.
[[nodiscard]] Result<void> write_scan_truth(const std::filesystem::path& recording,
                                            const ScanPictures& pictures,
                                            const simulated::SensorModel& sensor,
                                            const std::vector<Shown>& shown,
                                            const Workers& workers);

/// The same where only the first frame with lines is known: it shows the sensor at rest.
/// @errors  As write_scan_truth; kInsufficient: no frame shows lines.
[[nodiscard]] Result<void> write_resting_truth(const std::filesystem::path& recording,
                                               const ScanPictures& pictures,
                                               const simulated::SensorModel& sensor,
                                               const Workers& workers);

}  // namespace flytri::scan
