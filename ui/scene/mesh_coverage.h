/// @file  How well each place of the finished mesh was seen.
#pragma once

#include <vector>

#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::ui {

/// By vertex: the coverage of the nearest surfel of the scan; thin if none is near, for example in
/// a closed hole. Without a scan: good everywhere.
[[nodiscard]] std::vector<Coverage> coverage_of(const TriangleMesh& mesh,
                                                const SurfelModel& scanned);

}  // namespace flytri::ui
