/// @file  The picture of the finished mesh, redrawn only if mesh, eye or colors change.
#pragma once

#include "ui/scene/mesh_painter.h"
#include "ui/scene/model_picture.h"

namespace flytri::ui {

/// While the eye moves, the vertices are drawn as surfels if the triangles take too long.
class MeshPicture {
 public:
  MeshPicture(MeshPainter painter, SplatPainter splats)
      : painter_(std::move(painter)), moving_(std::move(splats)) {}

  /// Shows this mesh. Nothing is sent to the graphics card if it is already shown.
  /// @param content  with a mesh
  /// @param scanned  what the mesh was made of, for its coverage
  void take(const SceneContent& content, const SurfelModel& scanned);
  /// @return  where the picture changed: everywhere or nowhere
  PixelBox update(const Eye& eye, const SceneOptions& options, double now_s);

  [[nodiscard]] const PictureTarget& shown() const { return is_coarse_ ? moving_.shown() : still_; }
  /// Surfels are shown; triangles replace them when the eye stops.
  [[nodiscard]] bool is_coarse() const { return is_coarse_; }
  /// Of the surfels that are shown; 0 for triangles.
  [[nodiscard]] double splat_radius_mm() const {
    return is_coarse_ ? store_.radius_mm() * radius_scale(moving_.detail_share()) : 0.0;
  }
  [[nodiscard]] const Eigen::AlignedBox3d& box_mm() const { return painter_.box_mm(); }
  [[nodiscard]] double latest_ms() const { return latest_ms_; }

 private:
  PixelBox draw_surfels(const SceneOptions& options, double now_s);
  PixelBox draw_triangles(const SceneOptions& options);

  MeshPainter painter_;
  ModelPicture moving_;
  SplatStore store_;
  std::vector<Coverage> coverage_;  ///< by vertex
  SurfelModel surfels_;             ///< of the mesh; empty until they are needed
  const TexturedMesh* mesh_ = nullptr;
  std::uint64_t number_ = 0, undercut_ = 0;
  Tints tints_;
  bool is_new_ = false;
  bool is_coarse_ = false;
  Eye eye_;
  SceneOptions options_;
  PictureTarget still_;
  double triangles_ms_ = 0.0;  ///< of the last picture of triangles
  double latest_ms_ = 0.0;     ///< of the last update
};

}  // namespace flytri::ui
