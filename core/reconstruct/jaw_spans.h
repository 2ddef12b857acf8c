/// @file  The distances across a jaw that a dentist asks for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/jaw_axes.h"
#include "core/geometry/triangle_mesh.h"
#include "core/io/cases/case_file.h"
#include "core/refinement/length_uncertainty.h"

namespace flytri::reconstruct {

enum class JawSpanKind {
  kLastTeeth,  ///< of an arch: from its last tooth on one side to that on the other
  kPremolars,  ///< of an arch: from one side to the other
  kHalf,       ///< of an arch: from its front teeth to the last tooth of one side
  kLength,     ///< of a quadrant or any other part: from end to end
};

struct JawSpan {
  JawSpanKind kind = JawSpanKind::kLength;
  /// Of a half: the patient's left or right. None: not known whether it is an upper or lower jaw.
  std::optional<bool> is_right;
  refinement::Span ends;  ///< on the surface
};
/// A name for it in reports: "front to last tooth, left".
[[nodiscard]] std::string name_of(const JawSpan& span);

/// Which jaw a stage is. None: a bite, which has no left and right of its own.
[[nodiscard]] std::optional<JawKind> jaw_of(io::ScanStage stage);

/// The spans of which both ends were scanned. The ends are on chewing surfaces and edges, in the
/// middle of what was scanned there.
/// @param jaw  tells left from right
[[nodiscard]] std::vector<JawSpan> jaw_spans(const TriangleMesh& mesh, std::optional<JawKind> jaw);

/// A span of which is known how uncertain it is.
struct JudgedSpan {
  JawSpan span;
  double sigma_mm = 0.0;  ///< standard uncertainty of its length
  /// The true length is within this of the measured one with 95 %, if errors are normal.
  [[nodiscard]] double range95_mm() const { return 1.96 * sigma_mm; }
};

/// @param mesh   made of the views
/// @param views  with refined poses
/// @errors  As length_uncertainties.
[[nodiscard]] Result<std::vector<JudgedSpan>> judge_spans(
    const TriangleMesh& mesh, std::optional<JawKind> jaw, std::span<const AlignedView> views,
    const refinement::JointRefineOptions& refinement, const Workers& workers,
    const Progress& progress = {});

}  // namespace flytri::reconstruct
