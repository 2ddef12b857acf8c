/// @file  Cuts a mesh into charts that lie flat in an image, and packs them into one square.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::texture {

/// A connected piece of the mesh, projected along its mean normal. No texel center lies in two of
/// its triangles.
struct Chart {
  std::vector<std::uint32_t> triangles;  ///< indices into the mesh, rising
  Vec3f axis_u, axis_v;                  ///< directions of the image in the world frame, unit
  /// Place of the chart's lower bounds, gutter included, in its own projection, texels.
  Eigen::Array2i origin_px = {0, 0};
  Eigen::Array2i size_px = {0, 0};    ///< gutter included
  Eigen::Array2i corner_px = {0, 0};  ///< upper left, in the atlas; set by pack_charts
};

struct ChartOptions {
  double texel_mm = 0.05;  ///< > 0, edge of a texel on a surface that faces the projection
  /// (0, 1). A triangle that turns away from its chart with a smaller cosine goes to another one:
  /// it would get too few texels.
  double min_cosine = 0.5;
  /// >= 16. Larger charts are cut: small ones pack better. Texels.
  int max_chart_px = 256;
  /// >= 1. Texels around a chart that belong to it: filtering does not reach its neighbors.
  int gutter_px = 2;
};

/// Where a vertex lies in a chart's own projection, texels; centers of texels are at halves.
[[nodiscard]] Eigen::Array2f project_to_chart(const Chart& chart, const Vec3f& position_mm,
                                              double texel_mm);

/// The same point in the atlas, texels.
[[nodiscard]] inline Eigen::Array2f to_atlas(const Chart& chart, const Eigen::Array2f& projected) {
  return projected + (chart.corner_px - chart.origin_px).cast<float>();
}

/// Every triangle gets into exactly one chart.
/// @param mesh      indices valid
/// @param progress  advanced by one step
/// @errors  kCancelled.
[[nodiscard]] Result<std::vector<Chart>> cut_charts(const TriangleMesh& mesh,
                                                    const ChartOptions& options,
                                                    const Progress& progress = {});

/// Gives every chart a corner so that none overlap.
/// @param side_px  of the square atlas
/// @returns false if they do not fit; the corners are then not to be used.
/// @source  shelves by falling height: Coffman et al., SIAM J. Computing 9, 1980.
[[nodiscard]] bool pack_charts(std::vector<Chart>& charts, int side_px);

}  // namespace flytri::texture
