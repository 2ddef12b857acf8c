/// @file  A margin line, and the surface as it was made anew -> whether the line still holds.
#pragma once

#include <optional>
#include <span>

#include "core/base/workers.h"
#include "core/geometry/mesh_distance.h"
#include "core/review/margin.h"

namespace flytri::review {

/// Points of a line lie on its surface up to rounding, mm.
inline constexpr double kOnSurface_mm = 0.002;
/// A line that was drawn anew may lie this far from the former one, mm: a new alignment moves a
/// surface by tenths of that, and the next edge of a tooth is farther away.
inline constexpr double kMoved_mm = 0.3;

/// Whether all points of the line lie on this surface: then it was drawn on it.
[[nodiscard]] bool lies_on(const Polyline& line, const MeshDistance& surface);

/// The margin line on a surface: as it is if it was drawn there, else found anew from its clicks.
/// None: there is no edge any more, or it is not where it was.
/// @param mesh  as for find_margin
/// @param distance  of the same mesh
[[nodiscard]] std::optional<Margin> on_surface(const Margin& margin,
                                               std::span<const Vec3> clicks_mm,
                                               const TriangleMesh& mesh,
                                               const MeshDistance& distance,
                                               const Workers& workers);

}  // namespace flytri::review
