/// @file  How well each place of the finished mesh was seen.
#pragma once

#include <vector>

#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::ui {

/// By vertex: the coverage of the nearest surfel of the scan; thin where none is near, as where a
/// hole was closed. Without a scan: good everywhere, as nothing is known to be missing.
[[nodiscard]] std::vector<Coverage> coverage_of(const TriangleMesh& mesh,
                                                const SurfelModel& scanned);

}  // namespace flytri::ui
