/// @file  An indexed triangle mesh with normals, colors and an optional texture atlas.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid.h"

namespace flytri {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Vertices are SurfacePoints, so position, normal, color and uncertainty stay together.
struct TriangleMesh {
  std::vector<SurfacePoint> vertices;
  std::vector<Triangle> triangles;
};

/// A mesh cut into charts, with texture coordinates in one image. `mesh.vertices` has one copy of a
/// vertex for each of its charts; `uv` is parallel to it. As in glTF, (0, 0) is the upper left
/// corner of the image and (1, 1) the lower right.
struct TexturedMesh {
  TriangleMesh mesh;
  std::vector<Eigen::Vector2f> uv;  ///< empty: no texture
  cv::Mat atlas;                    ///< CV_8UC3, R, G, B order, sRGB; empty: no texture
};

}  // namespace flytri
