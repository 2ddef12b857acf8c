/// @file  Generates a colored sample jaw: gum and fourteen different teeth.
#pragma once

#include <cstdint>

#include "assets/sample_jaw/dentition.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::sample_jaw {

struct SampleJawOptions {
  JawKind kind = JawKind::kUpper;
  double tooth_cell_mm = 0.15;  ///< 0.05..2, length of the triangles on the teeth
  double gum_cell_mm = 0.3;     ///< 0.05..2, length of the triangles on the gum, which is smoother
  std::uint64_t seed = 1;       ///< seed of the individual shapes
  /// The teeth that the jaw has, by their number from -x to +x. Where one is missing, the gum has
  /// healed to a ridge; none(): an edentulous jaw.
  ToothSet teeth = kAllTeeth;
  [[nodiscard]] Result<void> validate() const;
};

/// About 75 x 60 x 25 mm; x to the side, y to the front, z towards the opposing teeth. Triangles
/// face outwards; vertices have normals and colors. Where tooth and gum meet, some vertices of one
/// are hidden inside the other. The result is bit-identical for any number of threads.
/// @errors  kBadOption.
[[nodiscard]] Result<TriangleMesh> make_sample_jaw(const SampleJawOptions& options,
                                                   const Workers& workers);

}  // namespace flytri::sample_jaw
