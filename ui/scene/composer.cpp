#include "ui/scene/composer.h"

#include <algorithm>
#include <cmath>

#include "ui/scene/coloring.h"

namespace flytri::ui {

namespace {

/// Radius of the search for grooves around a pixel.
float groove_reach_px(const Eye& eye) { return 0.009F * static_cast<float>(eye.size.height_px); }

/// Half the width of the gaps between splats that are closed: well below the radius of a splat, so
/// that real gaps stay.
float gap_px(const Eye& eye, float splat_radius_mm) {
  constexpr double kOfRadius = 0.4;
  constexpr double kWidest_px = 6.0;
  const double radius_px = splat_radius_mm * eye.size.height_px / eye.height_mm;
  return static_cast<float>(std::clamp(std::round(kOfRadius * radius_px), 1.0, kWidest_px));
}

/// The mean radius changes slowly while the model grows: small changes do not redraw everything.
bool look_same(const Backdrop& a, const Backdrop& b) {
  constexpr float kCreep = 0.15F;
  return a.is_dimmed == b.is_dimmed && a.top == b.top && a.bottom == b.bottom &&
         std::abs(a.splat_radius_mm - b.splat_radius_mm) <= kCreep * b.splat_radius_mm;
}

PixelBox widened(const PixelBox& box, int margin_px) {
  const Eigen::Vector2i margin = Eigen::Vector2i::Constant(margin_px);
  return {box.min() - margin, box.max() + margin};
}

/// A change also affects the grooves around it.
PixelBox with_grooves(const PixelBox& changed_px, const Eye& eye) {
  if (changed_px.isEmpty()) return changed_px;
  return widened(changed_px, static_cast<int>(std::ceil(groove_reach_px(eye))) + 1);
}

/// The pixels that the lines may cover.
PixelBox pixels_of(const std::vector<OverlayLine>& lines, const Eye& eye) {
  PixelBox pixels;
  for (const OverlayLine& line : lines) {
    Eigen::AlignedBox3f box_mm(line.from_mm);
    box_mm.extend(line.to_mm);
    const PixelBox middle = eye.pixels_of(box_mm);
    if (middle.isEmpty()) continue;
    // Half the width and a pixel for its soft border.
    pixels.extend(widened(middle, static_cast<int>(std::ceil(0.5F * line.width_px)) + 2));
  }
  return pixels.intersection(whole_picture(eye.size));
}

/// While it exists, drawing is limited to a part of the picture.
class ScissorTo {
 public:
  explicit ScissorTo(const PixelBox& part) {
    const Eigen::Vector2i size_px = part.sizes() + Eigen::Vector2i::Ones();
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.min().x(), part.min().y(), size_px.x(), size_px.y());
  }
  ~ScissorTo() { glDisable(GL_SCISSOR_TEST); }
  ScissorTo(const ScissorTo&) = delete;
  ScissorTo& operator=(const ScissorTo&) = delete;
};

}  // namespace

Result<Composer> Composer::create() {
  Result<ShaderProgram> program = ShaderProgram::load("compose.vert", "compose.frag");
  if (!program) return tl::unexpected(program.error());
  Result<LinePainter> lines = LinePainter::create();
  if (!lines) return tl::unexpected(lines.error());
  return Composer(std::move(*program), std::move(*lines));
}

Composer::Composer(ShaderProgram program, LinePainter painter)
    : program_(std::move(program)),
      painter_(std::move(painter)),
      no_vertices_(VertexArray::make()) {}

void Composer::resize(const PictureSize& size) {
  surface_ = Texture::make(size.width_px, size.height_px, GL_RGBA8);
  picture_ = Texture::make(size.width_px, size.height_px, GL_RGBA8);
  onto_surface_ = Framebuffer::make(surface_);
  onto_picture_ = Framebuffer::make(picture_);
}

PixelBox Composer::compose(const PictureTarget& model, const PixelBox& changed_px,
                           const std::vector<OverlayLine>& lines, const Eye& eye,
                           const Backdrop& backdrop) {
  const PixelBox whole = whole_picture(eye.size);
  const bool is_resized =
      surface_.width_px() != eye.size.width_px || surface_.height_px() != eye.size.height_px;
  if (is_resized) resize(eye.size);
  const bool is_all = is_resized || !look_same(backdrop, backdrop_);
  if (is_all) backdrop_ = backdrop;
  PixelBox part = is_all ? whole : with_grooves(changed_px, eye).intersection(whole);
  if (!part.isEmpty()) compose_surface(model, part, eye);
  const bool are_others = lines != lines_ || eye != eye_;
  eye_ = eye;
  if (are_others) part.extend(lines_px_);
  lines_ = lines;
  lines_px_ = pixels_of(lines_, eye);
  if (are_others) part.extend(lines_px_);
  if (!part.isEmpty()) add_lines(model, part, eye);
  return part;
}

void Composer::compose_surface(const PictureTarget& model, const PixelBox& part, const Eye& eye) {
  constexpr float kDimming = 0.62F;
  /// Size of darkened grooves, as a share of the picture's height.
  constexpr double kGroove = 0.006;
  onto_surface_.bind();
  glDisable(GL_DEPTH_TEST);
  const ScissorTo scissor(part);
  program_.use();
  model.color.bind(0);
  model.depth.bind(1);
  program_.set("model_color", 0);
  program_.set("model_depth", 1);
  program_.set("size_px", eye.size_px());
  program_.set("background_top", rgb_of(backdrop_.top));
  program_.set("background_bottom", rgb_of(backdrop_.bottom));
  program_.set("dimming", backdrop_.is_dimmed ? kDimming : 0.0F);
  // Normalized depth is -P22 + P23 / distance, see OrbitCamera::projection.
  program_.set("depth_to_mm", Eigen::Vector2f(eye.P_clip_eye(2, 2), eye.P_clip_eye(2, 3)));
  program_.set("groove_mm", static_cast<float>(kGroove * eye.height_mm));
  program_.set("splat_radius_mm", backdrop_.splat_radius_mm);
  program_.set("gap_px", gap_px(eye, backdrop_.splat_radius_mm));
  program_.set("reach_px", groove_reach_px(eye));
  no_vertices_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Composer::add_lines(const PictureTarget& model, const PixelBox& part, const Eye& eye) {
  onto_picture_.copy_color(onto_surface_, part);
  if (lines_.empty()) return;
  // Lines are compared with the depth of the model.
  const Framebuffer onto = Framebuffer::make(picture_, model.depth);
  onto.bind();
  const ScissorTo scissor(part);
  painter_.paint(lines_, eye);
}

}  // namespace flytri::ui
