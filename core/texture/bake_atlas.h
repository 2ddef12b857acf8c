/// @file  Bakes a texture atlas for a mesh from the texture frames.
#pragma once

#include "core/geometry/triangle_mesh.h"
#include "core/texture/color_points.h"

namespace flytri::texture {

struct AtlasOptions {
  /// 16..16384, a power of two. Largest side of the atlas, texels.
  int max_side_px = 2048;
  /// (0, 10]. Texel on the surface in pixels of the texture camera in the middle of the volume:
  /// finer ones would show nothing new. They become coarser where the atlas has no room.
  double texel_px = 1.0;
  TextureOptions coloring;

  [[nodiscard]] Result<void> validate() const;
};

/// A mesh with its atlas, and where the texels' colors came from.
struct BakedAtlas {
  TexturedMesh model;
  ColorCounts texels;
  int chart_count = 0;
  double texel_mm = 0.0;
};

/// Every texel is a point of the surface, colored as color_points does it. Texels that no frame saw
/// take the color of the mesh's vertices around them; so do all beyond the charts' borders.
/// @param mesh      colored; its vertices are repeated in each chart they belong to
/// @param progress  advanced by one step
/// @errors  kBadOption, kInsufficient: no triangles, or more charts than the atlas can hold;
///          kCancelled; as color_points.
[[nodiscard]] Result<BakedAtlas> bake_atlas(const TriangleMesh& mesh,
                                            std::span<const TextureFrame> frames,
                                            const calibration::Calibration& calibration,
                                            const AtlasOptions& options, const Workers& workers,
                                            const Progress& progress = {});

}  // namespace flytri::texture
