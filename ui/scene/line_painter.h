/// @file  Draws thick, smooth lines.
#pragma once

#include <vector>

#include "ui/gpu/buffer.h"
#include "ui/gpu/shader_program.h"
#include "ui/scene/overlay_lines.h"

namespace flytri::ui {

class LinePainter {
 public:
  /// @errors  those of ShaderProgram::load.
  [[nodiscard]] static Result<LinePainter> create();
  /// Draws into the bound framebuffer; tests its depth, but does not change it.
  void paint(const std::vector<OverlayLine>& lines, const Eye& eye);

 private:
  explicit LinePainter(ShaderProgram program);
  ShaderProgram program_;
  Buffer corners_;
  Buffer indices_;
  VertexArray vertices_;
  std::size_t indexed_lines_ = 0;
};

}  // namespace flytri::ui
