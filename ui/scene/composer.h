/// @file  Combines the picture of the model, the background and the lines.
#pragma once

#include <vector>

#include "ui/gpu/buffer.h"
#include "ui/scene/line_painter.h"
#include "ui/scene/model_picture.h"

namespace flytri::ui {

/// How the model is combined with the background.
struct Backdrop {
  bool is_dimmed = false;        ///< the model is drawn darker
  float splat_radius_mm = 0.0F;  ///< a splat has a single depth; 0 for a mesh
  Color top;
  Color bottom;
};

class Composer {
 public:
  /// @errors  those of ShaderProgram::load.
  [[nodiscard]] static Result<Composer> create();

  /// @param changed_px  where the picture of the model changed
  /// @return  where the combined picture changed
  PixelBox compose(const PictureTarget& model, const PixelBox& changed_px,
                   const std::vector<OverlayLine>& lines, const Eye& eye, const Backdrop& backdrop);
  [[nodiscard]] const Framebuffer& picture() const { return onto_picture_; }

 private:
  Composer(ShaderProgram program, LinePainter painter);
  void resize(const PictureSize& size);
  void compose_surface(const PictureTarget& model, const PixelBox& part, const Eye& eye);
  void add_lines(const PictureTarget& model, const PixelBox& part, const Eye& eye);

  ShaderProgram program_;
  LinePainter painter_;
  VertexArray no_vertices_;
  Texture surface_;  ///< without lines, which change more often
  Texture picture_;  ///< with them
  Framebuffer onto_surface_, onto_picture_;
  Backdrop backdrop_;  ///< of the surface
  Eye eye_;
  std::vector<OverlayLine> lines_;  ///< in the picture
  PixelBox lines_px_;               ///< where they are
};

}  // namespace flytri::ui
