#include "core/texture/vertex_colors.h"

#include <algorithm>

namespace flytri::texture {

void color_vertices(TexturedMesh& model) {
  if (model.atlas.empty()) return;
  const cv::Mat_<cv::Vec3b> atlas = model.atlas;
  const auto texel = [](float share, int count) {
    return std::clamp(static_cast<int>(share * static_cast<float>(count)), 0, count - 1);
  };
  for (std::size_t i = 0; i < model.uv.size(); ++i) {
    const cv::Vec3b color =
        atlas(texel(model.uv[i].y(), atlas.rows), texel(model.uv[i].x(), atlas.cols));
    model.mesh.vertices[i].color = {color[0], color[1], color[2]};
  }
}

}  // namespace flytri::texture
