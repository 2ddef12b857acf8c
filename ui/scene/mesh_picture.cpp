#include "ui/scene/mesh_picture.h"

#include "ui/gpu/frame_timer.h"
#include "ui/scene/coloring.h"
#include "ui/scene/vertex_format.h"

namespace flytri::ui {

void MeshPicture::take(const TexturedMesh& mesh, std::uint64_t number,
                       const std::vector<BrushDab>& locked) {
  if (&mesh == mesh_ && number == number_ && are_same(locked, locked_)) return;
  painter_.take(mesh, locked);
  mesh_ = &mesh;
  number_ = number;
  locked_ = locked;
  is_new_ = true;
}

PixelBox MeshPicture::update(const Eye& eye, const SceneOptions& options) {
  latest_ms_ = 0.0;
  if (!is_new_ && eye == eye_ && look_same(options, options_)) return {};
  if (eye.size != eye_.size) shown_ = PictureTarget::make(eye.size);
  is_new_ = false;
  eye_ = eye;
  options_ = options;
  const FrameTimer timer;
  shown_.clear();
  painter_.paint(eye, options);
  latest_ms_ = timer.stop_ms();
  return whole_picture(eye.size);
}

}  // namespace flytri::ui
