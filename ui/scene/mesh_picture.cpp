#include "ui/scene/mesh_picture.h"

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

bool MeshPicture::update(const Eye& eye, const SceneOptions& options) {
  while (const auto work = timer_.take()) latest_ms_ = work->ms;
  if (!is_new_ && eye == eye_ && look_same(options, options_)) return false;
  if (eye.size != eye_.size) shown_ = PictureTarget::make(eye.size);
  is_new_ = false;
  eye_ = eye;
  options_ = options;
  timer_.begin();
  shown_.clear();
  painter_.paint(eye, options);
  timer_.end(1);
  return true;
}

}  // namespace flytri::ui
