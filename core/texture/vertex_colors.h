/// @file  Vertex colors from the atlas, for formats without an atlas.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri::texture {

/// Color of the texel at finite texture coordinates; outside of 0 to 1 that of the nearest border.
Rgb texel_at(const cv::Mat& atlas, const Eigen::Vector2f& uv);

/// Gives each vertex its color in the atlas. Does nothing without an atlas.
void color_vertices(TexturedMesh& model);

}  // namespace flytri::texture
