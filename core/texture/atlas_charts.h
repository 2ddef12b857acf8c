/// @file  Cuts a mesh into flat charts and packs them into a square atlas.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::texture {

/// A connected piece of the mesh, projected along its mean normal. Its triangles do not overlap in
/// the projection.
struct Chart {
  std::vector<std::uint32_t> triangles;  ///< indices into the mesh, rising
  Vec3f axis_u, axis_v;                  ///< directions of the image in the world frame, unit
  /// Lower bounds of the chart in its projection, with gutter, texels.
  Eigen::Array2i origin_px = {0, 0};
  Eigen::Array2i size_px = {0, 0};    ///< with gutter
  Eigen::Array2i corner_px = {0, 0};  ///< upper left corner in the atlas; set by pack_charts
};

struct ChartOptions {
  double texel_mm = 0.05;  ///< > 0, edge of a texel on a surface parallel to the chart
  /// (0, 1). Least cosine between the normals of a triangle and its chart. Otherwise the triangle
  /// goes to another chart, because it would get too few texels.
  double min_cosine = 0.5;
  /// >= 16. Largest side of a chart, texels. Larger charts are cut: small ones pack better.
  int max_chart_px = 256;
  /// >= 1. Margin of texels around a chart, so that texture filtering does not mix charts.
  int gutter_px = 2;
};

/// Position of a vertex in the chart's projection, in texels. The centers of texels are at n + 0.5.
[[nodiscard]] Eigen::Array2f project_to_chart(const Chart& chart, const Vec3f& position_mm,
                                              double texel_mm);

/// The same point in the atlas, texels.
[[nodiscard]] inline Eigen::Array2f to_atlas(const Chart& chart, const Eigen::Array2f& projected) {
  return projected + (chart.corner_px - chart.origin_px).cast<float>();
}

/// Every triangle belongs to exactly one chart.
/// @param mesh      indices valid
/// @param progress  advanced by one step
/// @errors  kCancelled.
[[nodiscard]] Result<std::vector<Chart>> cut_charts(const TriangleMesh& mesh,
                                                    const ChartOptions& options,
                                                    const Progress& progress = {});

/// Places the charts in the atlas without overlap.
/// @param side_px  of the square atlas
/// @returns false if they do not fit; then the corners are invalid.
/// @source  shelf packing by falling height: Coffman et al., SIAM J. Computing 9, 1980.
[[nodiscard]] bool pack_charts(std::vector<Chart>& charts, int side_px);

}  // namespace flytri::texture
