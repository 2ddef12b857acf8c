#include "ui/scene/mesh_picture.h"

#include "ui/gpu/frame_timer.h"
#include "ui/scene/coloring.h"
#include "ui/scene/mesh_coverage.h"
#include "ui/scene/mesh_surfels.h"
#include "ui/scene/vertex_format.h"

namespace flytri::ui {

void MeshPicture::take(const SceneContent& content, const SurfelModel& scanned) {
  const TexturedMesh& mesh = *content.mesh;
  const bool is_known = &mesh == mesh_ && content.mesh_number == number_;
  const std::uint64_t undercut = content.undercut ? content.undercut->number : 0;
  if (is_known && undercut == undercut_ && are_same(content.tints, tints_)) return;
  const MeshPainter::Marks marks = {coverage_, content.tints, content.jaws, content.undercut};
  if (is_known) {
    painter_.mark(mesh, marks);
  } else {
    coverage_ = content.jaws ? std::vector(mesh.mesh.vertices.size(), Coverage::kGood)
                             : coverage_of(mesh.mesh, scanned);
    painter_.take(mesh, marks);
    surfels_.clear();
  }
  mesh_ = &mesh;
  number_ = content.mesh_number;
  undercut_ = undercut;
  tints_ = content.tints;
  is_new_ = true;
}

PixelBox MeshPicture::update(const Eye& eye, const SceneOptions& options, double now_s) {
  latest_ms_ = 0.0;
  const bool has_moved = eye != eye_;
  if (eye.size != eye_.size) still_ = PictureTarget::make(eye.size);
  const bool looks_different = !look_same(options, options_);
  eye_ = eye;
  options_ = options;
  if (!is_new_ && has_moved && options.level_of_detail && triangles_ms_ > options.moving_frame_ms) {
    return draw_surfels(options, now_s);
  }
  if (is_new_ || has_moved || looks_different || is_coarse_) return draw_triangles(options);
  return {};
}

PixelBox MeshPicture::draw_surfels(const SceneOptions& options, double now_s) {
  if (surfels_.empty()) surfels_ = surfels_of(*mesh_, coverage_);
  const StoreChanges changes = store_.update(surfels_, tints_);
  is_coarse_ = true;
  (void)moving_.update(store_, changes, eye_, options, now_s);
  latest_ms_ = moving_.latest_ms();
  return whole_picture(eye_.size);
}

PixelBox MeshPicture::draw_triangles(const SceneOptions& options) {
  is_new_ = false;
  is_coarse_ = false;
  const FrameTimer timer;
  still_.clear();
  painter_.paint(eye_, options);
  latest_ms_ = triangles_ms_ = timer.stop_ms();
  return whole_picture(eye_.size);
}

}  // namespace flytri::ui
