/// @file  Draws the finished mesh with its texture atlas.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"
#include "ui/gpu/buffer.h"
#include "ui/gpu/shader_program.h"
#include "ui/gpu/texture.h"
#include "ui/scene/eye.h"
#include "ui/scene/scene_content.h"
#include "ui/scene/scene_options.h"
#include "ui/scene/vertex_format.h"

namespace flytri::ui {

class MeshPainter {
 public:
  /// @errors  those of ShaderProgram::load.
  [[nodiscard]] static Result<MeshPainter> create();

  /// What is drawn of a mesh beside its shape and colors.
  struct Marks {
    const std::vector<Coverage>& coverage;  ///< by vertex
    const Tints& tints;
    const std::optional<SceneJaws>& jaws;
    const std::optional<SceneUndercut>& undercut;
  };
  /// Sends a mesh to graphics memory.
  void take(const TexturedMesh& mesh, const Marks& marks);
  /// Sends only the vertices anew, with other marks.
  void mark(const TexturedMesh& mesh, const Marks& marks);
  /// Draws into the bound framebuffer. Triangles seen from behind are skipped.
  void paint(const Eye& eye, const SceneOptions& options) const;

  [[nodiscard]] const Eigen::AlignedBox3d& box_mm() const { return box_mm_; }

 private:
  explicit MeshPainter(ShaderProgram program);
  ShaderProgram program_;
  Buffer buffer_;
  Buffer indices_;
  VertexArray vertices_;
  Texture atlas_;
  bool has_atlas_ = false;
  GLsizei index_count_ = 0;
  Eigen::AlignedBox3d box_mm_;
};

}  // namespace flytri::ui
