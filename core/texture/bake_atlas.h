/// @file  Bakes a texture atlas for a mesh from the texture frames.
#pragma once

#include "core/geometry/triangle_mesh.h"
#include "core/texture/color_points.h"

namespace flytri::texture {

struct AtlasOptions {
  /// 16..16384, a power of two. Largest side of the atlas, texels.
  int max_side_px = 2048;
  /// (0, 10]. Size of a texel on the surface, in pixels of the texture camera in the middle of the
  /// volume: smaller texels would show no more detail. Texels become larger if the atlas has no
  /// room.
  double texel_px = 1.0;
  TextureOptions coloring;

  [[nodiscard]] Result<void> validate() const;
};

/// A mesh with its atlas, and the sources of the texel colors.
struct BakedAtlas {
  TexturedMesh model;
  ColorCounts texels;
  int chart_count = 0;
  double texel_mm = 0.0;
};

/// Every texel is a point of the surface, colored as in color_points. Texels that no frame saw get
/// the interpolated color of the vertices around them. Texels beyond the borders of charts get the
/// color of their neighbors.
/// @param mesh      with vertex colors; a vertex is copied for each of its charts
/// @param progress  advanced by one step
/// @errors  kBadOption, kInsufficient: no triangles, or the charts do not fit into the atlas;
///          kCancelled; as color_points.
[[nodiscard]] Result<BakedAtlas> bake_atlas(const TriangleMesh& mesh,
                                            std::span<const TextureFrame> frames,
                                            const calibration::Calibration& calibration,
                                            const AtlasOptions& options, const Workers& workers,
                                            const Progress& progress = {});

}  // namespace flytri::texture
