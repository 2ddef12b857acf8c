/// @file  The densities in which a finished model is written: full, for CAD, light.
#pragma once

#include <array>
#include <string_view>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "core/meshing/simplify.h"

namespace flytri::reconstruct {

/// The bounds are those of a jaw. They grow with the spacing of the vertices, from 0.2 mm on.
enum class MeshDensity {
  kFull,  ///< as it was meshed
  kCad,   ///< at most 2 um RMS and 10 um anywhere from the full surface
  kLight  ///< at most 10 um RMS and 50 um: for a look, or a slow line
};
inline constexpr std::array kMeshDensities = {MeshDensity::kFull, MeshDensity::kCad,
                                              MeshDensity::kLight};

/// "full", "cad" or "light".
[[nodiscard]] std::string_view to_string(MeshDensity density);

/// The name of this stage, shown to the user.
inline constexpr auto kThinningTriangles = "Thinning the triangles";

/// The bounds of a density other than kFull.
/// @param spacing_mm  of the vertices of the full mesh
/// @param texel_mm  edge of a texel on the surface: seams of the texture keep within one; 0
///                  without a texture
[[nodiscard]] meshing::SimplifyOptions simplify_options(MeshDensity density, double spacing_mm,
                                                        double texel_mm);

/// A finished model in one density.
struct ModelAtDensity {
  MeshDensity density = MeshDensity::kFull;
  TexturedMesh model;  ///< cut into charts if there is a texture, for formats with an atlas
  TriangleMesh uncut;  ///< the same triangles, for formats without
  double rms_mm = 0.0, max_mm = 0.0;  ///< what meshing::Simplified says; 0 if full
};

/// @param progress  advanced by one step
/// @errors  kCancelled.
[[nodiscard]] Result<ModelAtDensity> at_density(const TexturedMesh& model, MeshDensity density,
                                                const Progress& progress = {});

}  // namespace flytri::reconstruct
