/// @file  Finds where a bite scan lies on a jaw, from no guess.
#pragma once

#include <span>
#include <vector>

#include "core/base/workers.h"
#include "core/occlusion/jaw_surface.h"
#include "core/tracking/surface_map.h"

namespace flytri::occlusion {

/// A jaw that bite scans are laid on.
struct SearchedJaw {
  explicit SearchedJaw(const TriangleMesh& mesh);
  JawSurface surface;
  tracking::SurfaceMap map;
};

/// A bite scan laid on a jaw.
struct BitePlacement {
  Isometry T_jaw_bite = Isometry::Identity();
  std::vector<bool> on_jaw;  ///< by point of the bite: whether it lies on the jaw
  double share = 0.0;        ///< of the points that do
};

/// The placement at which most points lie on the jaw; share 0 if there is none.
/// @param points  of the bite scan, with normals
[[nodiscard]] BitePlacement place_bite(const SearchedJaw& jaw, std::span<const SurfacePoint> points,
                                       const Workers& workers);

/// Which points lie on a jaw at a given placement.
[[nodiscard]] BitePlacement lay_on(const JawSurface& jaw, std::span<const SurfacePoint> points,
                                   const Isometry& T_jaw_bite, const Workers& workers);

}  // namespace flytri::occlusion
