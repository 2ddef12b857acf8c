#include "app/report/scan_facts.h"

#include <ctime>
#include <system_error>

#include "core/base/iso_time.h"
#include "core/calibration/record/sensor_size.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/meshing/coverage_holes.h"

namespace flytri::report {

EditCounts count_edits(const editing::EditList& edits) {
  EditCounts counts;
  for (const auto& edit : *edits) {
    switch (edit->kind) {
      case editing::EditKind::kTrim:
        ++counts.trims;
        break;
      case editing::EditKind::kLock:
        ++counts.locks;
        break;
      case editing::EditKind::kUnlock:
        ++counts.unlocks;
        break;
    }
  }
  return counts;
}

std::vector<meshing::BoundaryLoop> ScanFacts::holes() const {
  return meshing::coverage_holes(surface.boundaries, calibration::least_hole_width_mm(volume_mm));
}

CalibrationFacts facts_of(const calibration::Calibration& calibration) {
  return {io::fingerprint(calibration), calibration.history,
          calibration.of(Pattern::kVertical).depth_residual_mm.rms,
          calibration.of(Pattern::kHorizontal).depth_residual_mm.rms};
}

ScanFacts facts_now(const std::filesystem::path& source) {
  ScanFacts facts;
  std::error_code unknown;
  const std::filesystem::path whole = std::filesystem::absolute(source, unknown);
  facts.source = (unknown ? source : whole.lexically_normal()).string();
  facts.made_at = iso_time(std::time(nullptr));
  facts.program = "flytri " FLYTRI_VERSION;
  return facts;
}

}  // namespace flytri::report
