/// @file  What a reconstruction tells about itself: on the terminal and as report.json.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/pipeline/reconstruct.h"

namespace flytri::cli {

/// Monotonic seconds, for ReconstructOptions::now_s.
[[nodiscard]] double steady_seconds();

/// Prints counts of frames, points, triangles and holes, and the time of each stage.
void print_summary(const Reconstruction& reconstruction);

/// Writes the model in the form that suits the ending: cut into charts with an atlas, or whole.
/// @errors  as write_model.
[[nodiscard]] Result<void> write_result(const std::filesystem::path& path,
                                        const Reconstruction& reconstruction);

/// Writes report.json; its keys are documented in docs/formats.md.
/// @errors  kNotPermitted, kWriteFailed.
[[nodiscard]] Result<void> write_report(const std::filesystem::path& path,
                                        const Reconstruction& reconstruction);

/// The poses of a report: frame index and T_world_sensor of each frame that has one.
struct ReportedPose {
  FrameIndex frame;
  Isometry T_world_sensor = Isometry::Identity();
};

/// Reads the poses back.
/// @errors  kNotFound, kNotPermitted, kBadFormat naming file and key.
[[nodiscard]] Result<std::vector<ReportedPose>> read_report_poses(
    const std::filesystem::path& path);

}  // namespace flytri::cli
