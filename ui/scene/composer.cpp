#include "ui/scene/composer.h"

#include <algorithm>
#include <cmath>

#include "ui/scene/coloring.h"

namespace flytri::ui {

namespace {

/// How far around a pixel grooves are looked for.
float groove_reach_px(const Eye& eye) { return 0.009F * static_cast<float>(eye.size.height_px); }

/// Half the width of gaps between splats that are closed: well below a splat's radius, so that
/// nothing is closed that a surfel could lie in.
float gap_px(const Eye& eye, float splat_radius_mm) {
  constexpr double kOfRadius = 0.4;
  constexpr double kWidest_px = 6.0;
  const double radius_px = splat_radius_mm * eye.size.height_px / eye.height_mm;
  return static_cast<float>(std::clamp(std::round(kOfRadius * radius_px), 1.0, kWidest_px));
}

}  // namespace

Result<Composer> Composer::create() {
  Result<ShaderProgram> program = ShaderProgram::load("compose.vert", "compose.frag");
  if (!program) return tl::unexpected(program.error());
  Result<LinePainter> lines = LinePainter::create();
  if (!lines) return tl::unexpected(lines.error());
  return Composer(std::move(*program), std::move(*lines));
}

Composer::Composer(ShaderProgram program, LinePainter lines)
    : program_(std::move(program)), lines_(std::move(lines)), no_vertices_(VertexArray::make()) {}

void Composer::compose(const PictureTarget& model, const PixelBox& changed_px,
                       const std::vector<OverlayLine>& lines, const Eye& eye,
                       const Backdrop& backdrop) {
  const PictureSize& size = eye.size;
  PixelBox to_compose = changed_px;
  if (surface_.width_px() != size.width_px || surface_.height_px() != size.height_px) {
    surface_ = Texture::make(size.width_px, size.height_px, GL_RGBA8);
    picture_ = Texture::make(size.width_px, size.height_px, GL_RGBA8);
    to_compose = whole_picture(size);
  }
  if (!(backdrop == backdrop_)) to_compose = whole_picture(size);
  backdrop_ = backdrop;
  if (!to_compose.isEmpty()) compose_surface(model, to_compose, eye, backdrop);
  has_lines_ = !lines.empty();
  if (has_lines_) add_lines(model, lines, eye);
}

void Composer::compose_surface(const PictureTarget& model, const PixelBox& changed_px,
                               const Eye& eye, const Backdrop& backdrop) {
  constexpr float kDimming = 0.62F;
  /// Grooves that are deepened, as a share of the picture's height.
  constexpr double kGroove = 0.006;
  const Framebuffer target = Framebuffer::make(surface_);
  target.bind();
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  // What changed shows in the grooves around it as well.
  const int margin_px = static_cast<int>(std::ceil(groove_reach_px(eye))) + 1;
  const Eigen::Vector2i corner = changed_px.min().array() - margin_px;
  const Eigen::Vector2i size_px = changed_px.sizes().array() + 2 * margin_px + 1;
  glScissor(corner.x(), corner.y(), size_px.x(), size_px.y());
  program_.use();
  model.color.bind(0);
  model.depth.bind(1);
  program_.set("model_color", 0);
  program_.set("model_depth", 1);
  program_.set("size_px", eye.size_px());
  program_.set("background_top", rgb_of(backdrop.top));
  program_.set("background_bottom", rgb_of(backdrop.bottom));
  program_.set("dimming", backdrop.is_dimmed ? kDimming : 0.0F);
  // Normalized depth is -P22 + P23 / distance, see OrbitCamera::projection.
  program_.set("depth_to_mm", Eigen::Vector2f(eye.P_clip_eye(2, 2), eye.P_clip_eye(2, 3)));
  program_.set("groove_mm", static_cast<float>(kGroove * eye.height_mm));
  program_.set("splat_radius_mm", backdrop.splat_radius_mm);
  program_.set("gap_px", gap_px(eye, backdrop.splat_radius_mm));
  program_.set("reach_px", groove_reach_px(eye));
  no_vertices_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
}

void Composer::add_lines(const PictureTarget& model, const std::vector<OverlayLine>& lines,
                         const Eye& eye) {
  const Framebuffer from = Framebuffer::make(surface_);
  // The lines are tested against the model's own depth.
  const Framebuffer onto = Framebuffer::make(picture_, model.depth);
  onto.copy_color(from);
  onto.bind();
  lines_.paint(lines, eye);
}

}  // namespace flytri::ui
