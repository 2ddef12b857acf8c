/// @file  Summarizes a reconstruction: on the terminal and as report.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/reconstruct/mesh_density.h"
#include "core/reconstruct/reconstruct.h"

namespace flytri::cli {

/// The "format" of report.json.
inline constexpr std::string_view kReportFormat = "flytri.report";

/// Monotonic seconds, for ReconstructOptions::now_s.
[[nodiscard]] double steady_seconds();

/// Prints counts of frames, points, triangles and holes, and the time of each stage.
/// @param volume_mm  of the sensor
void print_summary(const reconstruct::Reconstruction& reconstruction, const Vec3& volume_mm);

/// Prints how large the written mesh is, and what its simplification has added.
void print_density(const reconstruct::ModelAtDensity& model);

/// What a report is about.
struct ReportedResult {
  const reconstruct::Reconstruction& reconstruction;
  const reconstruct::ModelAtDensity& model;  ///< as it is written
  Vec3 volume_mm;                            ///< edge lengths of the sensor's measurement volume
};

/// The text of report.json.
[[nodiscard]] std::string report_text(const ReportedResult& result);

/// Writes report.json, for its owner only; its keys are documented in docs/formats.md.
/// @errors  kNotPermitted, kWriteFailed.
[[nodiscard]] Result<void> write_report(const std::filesystem::path& path,
                                        const ReportedResult& result);

/// A frame's pose in a report.
struct ReportedPose {
  FrameIndex frame;
  bool registered = false;  ///< from its own lines; false: interpolated, like texture frames
  Isometry T_world_sensor = Isometry::Identity();
};

/// The part of a report that evaluate reads.
struct Report {
  std::optional<Vec3> volume_mm;    ///< edge lengths of the measurement volume
  std::vector<ReportedPose> poses;  ///< of frames with a pose; at least one is registered
};

/// @param name  of the file, for messages
/// @errors  kBadFormat naming file and key, kInsufficient without poses.
[[nodiscard]] Result<Report> parse_report(std::string_view text, const std::string& name);

/// @errors  As read_file and parse_report.
[[nodiscard]] Result<Report> read_report(const std::filesystem::path& path);

}  // namespace flytri::cli
