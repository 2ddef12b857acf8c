/// @file  A jaw with spheres and a plate of known size, for the standard tests of scanners.
#pragma once

#include <vector>

#include "assets/sample_jaw/dentition.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::lab {

/// Jaw frame, mm. Five teeth carry a sphere: both last molars, both canines and a central incisor.
/// The plate lies on two teeth of one side.
struct StandardBody {
  TriangleMesh surface;
  std::vector<Vec3> spheres_mm;  ///< centers, along the arch
  double radius_mm = 0.0;        ///< of all spheres
  /// z is its normal, its measured face is at z = 0, x is along the arch.
  Isometry T_jaw_plate = Isometry::Identity();
  Vec2 plate_mm = Vec2::Zero();  ///< its size in x and y
};

/// @param jaw  the surface of this dentition
[[nodiscard]] StandardBody make_standard_body(const TriangleMesh& jaw,
                                              const sample_jaw::Dentition& dentition);

struct FittedSphere {
  Vec3 center_mm = Vec3::Zero();
  double radius_mm = 0.0;
  double rms_mm = 0.0;  ///< of the points' distances from it
};

/// Fits a sphere to the scanned points within 60 degrees of its top, by least squares.
/// @param scanned  laid on the body
/// @param sphere   number of the sphere
/// @errors  kInsufficient: it was hardly scanned.
[[nodiscard]] Result<FittedSphere> fit_sphere(const TriangleMesh& scanned, const StandardBody& body,
                                              std::size_t sphere);

/// RMS distance of the plate's scanned points from their best plane, mm. A border of 0.5 mm does
/// not count.
/// @param scanned, @errors  As fit_sphere.
[[nodiscard]] Result<double> plate_noise_mm(const TriangleMesh& scanned, const StandardBody& body);

}  // namespace flytri::lab
