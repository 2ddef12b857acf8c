/// @file  Surfaces with little structure, and how a hand scans them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "hw/simulated/hand/aimed_path.h"

namespace flytri::lab {

struct StructureScene {
  TriangleMesh mesh;
  simulated::SensorPath path;
};

/// ridge: 20 mm of an edentulous lower jaw, from above and from both sides. palate: three lines
/// between throat and rugae. tooth: one tooth on a ridge, and 9 mm on both sides of it. flat: 50 x
/// 40 mm with waves of 0.3 mm. plane: of 0.05 mm, which the noise hides: no view may get a pose.
/// jaw: as ridge, with all teeth, to compare.
[[nodiscard]] const std::vector<std::string>& structure_scene_names();

/// @param seed        of the shapes and the hand
/// @param duration_s  of the path: all of it is scanned, however fast
/// @errors  kBadOption: no such scene.
[[nodiscard]] Result<StructureScene> make_structure_scene(const std::string& name,
                                                          std::uint64_t seed, double duration_s,
                                                          const Workers& workers);

}  // namespace flytri::lab
