/// @file  What a report says about a finished scan.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/calibration/record/calibration.h"
#include "core/editing/edits.h"
#include "core/io/cases/case_file.h"
#include "core/meshing/surface_mesh.h"
#include "core/reconstruct/jaw_spans.h"

namespace flytri::report {

/// How many strokes of the brush are in effect.
struct EditCounts {
  std::size_t trims = 0, locks = 0, unlocks = 0;
};
[[nodiscard]] EditCounts count_edits(const editing::EditList& edits);

/// Which calibration measured the scan.
struct CalibrationFacts {
  std::string fingerprint;
  calibration::CalibrationHistory history;
  double vertical_rms_mm = 0.0, horizontal_rms_mm = 0.0;  ///< of the lines' depths in the planes
};
[[nodiscard]] CalibrationFacts facts_of(const calibration::Calibration& calibration);

struct ScanFacts {
  std::string source;                     ///< the case or the recording, whole path
  std::optional<io::CaseFields> patient;  ///< of a case
  std::optional<io::ScanStage> stage;     ///< of a case
  meshing::SurfaceMesh surface;           ///< welded; its holes
  std::vector<reconstruct::JudgedSpan> spans;
  std::size_t registered = 0;           ///< frames
  std::map<std::string, int> rejected;  ///< frames by reason
  EditCounts edits;
  CalibrationFacts calibration;
  Vec3 volume_mm = Vec3(20, 15, 15);  ///< of the sensor

  /// The holes to scan, see meshing::coverage_holes().
  [[nodiscard]] std::vector<meshing::BoundaryLoop> holes() const;
  std::string made_at;  ///< ISO 8601, UTC
  std::string program;  ///< "flytri 0.1.0"
};

/// Facts with their source, the present time and this program; the rest is empty.
[[nodiscard]] ScanFacts facts_now(const std::filesystem::path& source);

}  // namespace flytri::report
