/// @file  The finished mesh's picture, kept until mesh, eye or colors change.
#pragma once

#include "ui/scene/mesh_painter.h"
#include "ui/scene/model_picture.h"

namespace flytri::ui {

class MeshPicture {
 public:
  explicit MeshPicture(MeshPainter painter) : painter_(std::move(painter)) {}

  /// Shows this mesh from now on. Nothing is sent where it is the one already shown.
  /// @param number  another one for another mesh at the same address
  void take(const TexturedMesh& mesh, std::uint64_t number, const std::vector<BrushDab>& locked);
  /// @return where the picture is another one than before: all or nothing
  PixelBox update(const Eye& eye, const SceneOptions& options);

  [[nodiscard]] const PictureTarget& shown() const { return shown_; }
  [[nodiscard]] const Eigen::AlignedBox3d& box_mm() const { return painter_.box_mm(); }
  [[nodiscard]] double latest_ms() const { return latest_ms_; }

 private:
  MeshPainter painter_;
  const TexturedMesh* mesh_ = nullptr;
  std::uint64_t number_ = 0;
  std::vector<BrushDab> locked_;
  bool is_new_ = false;
  Eye eye_;
  SceneOptions options_;
  PictureTarget shown_;
  double latest_ms_ = 0.0;
};

}  // namespace flytri::ui
