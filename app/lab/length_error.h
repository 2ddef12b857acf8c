/// @file  How far off a distance across a scanned jaw is.
#pragma once

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::lab {

/// Error of a scanned distance, mm; positive: too long. Within 5 mm of each end, the scanned
/// surface is laid on the true one.
/// @param scanned  in the frame of the truth; its vertices count
/// @param from_mm, to_mm  on the true surface
/// @errors  kInsufficient: hardly anything was scanned at one of the places.
[[nodiscard]] Result<double> length_error_mm(const TriangleMesh& scanned, const TriangleMesh& truth,
                                             const Vec3& from_mm, const Vec3& to_mm,
                                             const Workers& workers);

}  // namespace flytri::lab
