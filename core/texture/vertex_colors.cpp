#include "core/texture/vertex_colors.h"

#include <algorithm>

namespace flytri::texture {

Rgb texel_at(const cv::Mat& atlas, const Eigen::Vector2f& uv) {
  // Limited before the conversion: a coordinate from a file may be too large for an int.
  const auto pixel = [](float share, int size) {
    const float last = static_cast<float>(size - 1);
    return static_cast<int>(std::clamp(share * static_cast<float>(size), 0.0F, last));
  };
  const auto& texel = atlas.at<cv::Vec3b>(pixel(uv.y(), atlas.rows), pixel(uv.x(), atlas.cols));
  return {texel[0], texel[1], texel[2]};
}

Rgb vertex_color(const TexturedMesh& model, std::size_t vertex) {
  if (model.atlas.empty()) return model.mesh.vertices[vertex].color;
  return texel_at(model.atlas, model.uv[vertex]);
}

void color_vertices(TexturedMesh& model) {
  if (model.atlas.empty()) return;
  for (std::size_t i = 0; i < model.uv.size(); ++i) {
    model.mesh.vertices[i].color = texel_at(model.atlas, model.uv[i]);
  }
}

}  // namespace flytri::texture
