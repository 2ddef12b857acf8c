/// @file  Generates a colored sample face, for the face sensor.
#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::sample_face {

struct SampleFaceOptions {
  double cell_mm = 1.0;    ///< 0.3..5, length of the triangles
  std::uint64_t seed = 1;  ///< of the skin's colors and of its small unevenness
  [[nodiscard]] Result<void> validate() const;
};

/// From ear to ear and from the chin to the hair, about 160 x 110 x 220 mm; x to the person's left,
/// y to the front, z up. Open at the back. Triangles face outwards; vertices have normals and
/// colors.
/// @errors  kBadOption.
[[nodiscard]] Result<TriangleMesh> make_sample_face(const SampleFaceOptions& options);

}  // namespace flytri::sample_face
