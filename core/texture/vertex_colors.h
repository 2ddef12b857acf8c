/// @file  Vertex colors from the atlas, for formats without an atlas.
#pragma once

#include "core/geometry/triangle_mesh.h"

namespace flytri::texture {

/// Color of the texel at finite texture coordinates; outside of 0 to 1 that of the nearest border.
Rgb texel_at(const cv::Mat& atlas, const Eigen::Vector2f& uv);

/// Color of a vertex: of its texel, or its own if there is no atlas.
[[nodiscard]] Rgb vertex_color(const TexturedMesh& model, std::size_t vertex);

/// Gives each vertex its color in the atlas. Does nothing without an atlas.
void color_vertices(TexturedMesh& model);

}  // namespace flytri::texture
