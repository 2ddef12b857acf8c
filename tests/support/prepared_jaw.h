/// @file  The sample jaw with a molar prepared for a crown, with its true margin.
#pragma once

#include <vector>

#include "core/geometry/rigid.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::testing {

/// All in the world frame of the jaw.
struct PreparedJaw {
  TriangleMesh mesh;            ///< each vertex has an uncertainty
  std::vector<Vec3> margin_mm;  ///< closed
  Vec3 tooth_mm;                ///< the middle of its chewing surface
};

/// Takes the first molar out of an upper sample jaw (seed 1), and puts a preparation with a
/// shoulder in its place. Its walls have no undercut along the tooth; below the margin there is
/// some.
/// @param jaw  in the world frame
[[nodiscard]] PreparedJaw prepared_jaw(const TriangleMesh& jaw, const Isometry& T_world_jaw);

}  // namespace flytri::testing
