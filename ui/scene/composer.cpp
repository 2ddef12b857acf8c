#include "ui/scene/composer.h"

#include "ui/scene/coloring.h"

namespace flytri::ui {

Result<Composer> Composer::create() {
  Result<ShaderProgram> program = ShaderProgram::load("compose.vert", "compose.frag");
  if (!program) return tl::unexpected(program.error());
  Result<LinePainter> lines = LinePainter::create();
  if (!lines) return tl::unexpected(lines.error());
  return Composer(std::move(*program), std::move(*lines));
}

Composer::Composer(ShaderProgram program, LinePainter lines)
    : program_(std::move(program)), lines_(std::move(lines)), no_vertices_(VertexArray::make()) {}

void Composer::compose(const PictureTarget& model, bool has_changed,
                       const std::vector<OverlayLine>& lines, const Eye& eye,
                       const Backdrop& backdrop) {
  constexpr float kDimming = 0.62F;
  /// Grooves that are deepened: as shares of the picture's height.
  constexpr double kGroove = 0.006, kReach = 0.009;
  const bool fits =
      picture_.width_px() == eye.size.width_px && picture_.height_px() == eye.size.height_px;
  if (fits && !has_changed && lines.empty() && !had_lines_ && backdrop == backdrop_) return;
  if (!fits) picture_ = Texture::make(eye.size.width_px, eye.size.height_px, GL_RGBA8);
  backdrop_ = backdrop;
  had_lines_ = !lines.empty();
  // The lines are tested against the model's own depth; it is not written here.
  const Framebuffer with_background = Framebuffer::make(picture_);
  with_background.bind();
  glDisable(GL_DEPTH_TEST);
  program_.use();
  model.color.bind(0);
  model.depth.bind(1);
  program_.set("model_color", 0);
  program_.set("model_depth", 1);
  program_.set("background_top", rgb_of(backdrop.top));
  program_.set("background_bottom", rgb_of(backdrop.bottom));
  program_.set("dimming", backdrop.is_dimmed ? kDimming : 0.0F);
  // Normalized depth is -P22 + P23 / distance, see OrbitCamera::projection.
  program_.set("depth_to_mm", Eigen::Vector2f(eye.P_clip_eye(2, 2), eye.P_clip_eye(2, 3)));
  program_.set("groove_mm", static_cast<float>(kGroove * eye.height_mm));
  program_.set("splat_radius_mm", backdrop.splat_radius_mm);
  program_.set("reach_px", static_cast<float>(kReach * eye.size.height_px));
  no_vertices_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  if (lines.empty()) return;
  const Framebuffer with_depth = Framebuffer::make(picture_, model.depth);
  with_depth.bind();
  lines_.paint(lines, eye);
}

}  // namespace flytri::ui
