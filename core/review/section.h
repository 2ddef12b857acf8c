/// @file  A mesh and a plane -> the outlines where the plane cuts the surface, and distances
///          measured on them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/review/measure.h"

namespace flytri::review {

struct Plane {
  Vec3 point_mm = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< of any length above 0
};

/// A line on the surface. The sigma of a point is that across the line.
struct Polyline {
  std::vector<MeasuredPoint> points;  ///< in order; a closed line does not repeat the first one
  bool is_closed = false;
};

/// The polyline's length.
///
/// u^2 = sum of sigma_i^2 |t_before - t_after|^2, with unit tangents t on both sides of a point.
/// @source  JCGM 100:2008 (GUM), equation (10). Noise also makes a line longer than the true one;
///          that is not in u.
[[nodiscard]] Measured length_mm(const Polyline& line);

/// RMS of the known sigmas of the line's points; 0 if none is known.
[[nodiscard]] double sigma_rms_mm(const Polyline& line);

/// Outlines of a section, the longest first.
///
/// If the normal of the plane points at you, an outline runs counterclockwise around the solid. The
/// sigma of a point is that of the surface along its normal, divided by the sine of the angle
/// between surface and plane. It is unknown where they only touch.
using Section = std::vector<Polyline>;

/// Cuts the mesh. A vertex on the plane counts as above it, so that each outline is whole: a flat
/// part in the plane has an outline where the surface goes down from it; where the surface only
/// touches the plane, there is none.
/// @param mesh  welded; outlines end at borders of the mesh, and where neighbors do not have the
///              same side outside
/// @errors  kBadOption: the plane has no direction; kInsufficient: it does not meet the mesh.
[[nodiscard]] Result<Section> section_of(const TriangleMesh& mesh, const Plane& plane);

/// A place on an outline.
struct SectionPlace {
  std::size_t outline = 0;
  double along_mm = 0.0;  ///< from the outline's first point
  MeasuredPoint point;
};

/// The place of the section that is nearest to a point.
/// @param section  has at least one outline
[[nodiscard]] SectionPlace nearest_place(const Section& section, const Vec3& p_mm);

/// The part of an outline between two of its places; of a closed one, the shorter part.
/// @errors  kInconsistent: the places are on different outlines.
[[nodiscard]] Result<Polyline> part_between(const Section& section, const SectionPlace& a,
                                            const SectionPlace& b);

}  // namespace flytri::review
