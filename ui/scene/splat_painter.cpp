#include "ui/scene/splat_painter.h"

#include <cmath>
#include <span>

#include "ui/scene/coloring.h"

namespace flytri::ui {

std::size_t prefix_length(std::size_t count, double detail_share) {
  return static_cast<std::size_t>(std::ceil(static_cast<double>(count) * detail_share));
}

double radius_scale(double detail_share) {
  /// Surfels lie on a grid, a prefix of them at random: n disks of radius r a unit of area leave
  /// exp(-pi r^2 n) of it bare, 3 % at the radius that closes a grid, and 0.15 % at 1.4 times that.
  constexpr double kAtRandom = 1.4;
  return (detail_share + kAtRandom * (1.0 - detail_share)) / std::sqrt(detail_share);
}

Result<SplatPainter> SplatPainter::create() {
  Result<ShaderProgram> program = ShaderProgram::load("splat.vert", "splat.frag");
  if (!program) return tl::unexpected(program.error());
  return SplatPainter(std::move(*program));
}

SplatPainter::SplatPainter(ShaderProgram program)
    : program_(std::move(program)), indices_(Buffer::make(GL_ARRAY_BUFFER, 0, GL_STREAM_DRAW)) {}

void SplatPainter::begin(const SplatStore& store, const Eye& eye, const SceneOptions& options,
                         double detail_share) {
  program_.use();
  eye.set_uniforms(program_);
  set_coloring(program_, options);
  program_.set("focal_px", eye.focal_px());
  program_.set("radius_scale", static_cast<float>(radius_scale(detail_share)));
  store.bind();
  glEnable(GL_DEPTH_TEST);
  // A surfel that is drawn again at the same place shows its new color.
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_PROGRAM_POINT_SIZE);
}

void SplatPainter::paint_some(const SplatStore& store, const std::vector<std::uint32_t>& surfels,
                              const Eye& eye, const SceneOptions& options, double detail_share) {
  if (surfels.empty()) return;
  indices_.assign(std::as_bytes(std::span(surfels)));
  begin(store, eye, options, detail_share);
  store.bind_indices(indices_);
  glDrawElements(GL_POINTS, static_cast<GLsizei>(surfels.size()), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_PROGRAM_POINT_SIZE);
}

std::size_t SplatPainter::paint(const SplatStore& store,
                                const std::vector<const StoredBlock*>& blocks, const Eye& eye,
                                const SceneOptions& options, double detail_share) {
  firsts_.clear();
  counts_.clear();
  std::size_t drawn = 0;
  for (const StoredBlock* stored : blocks) {
    if (!eye.may_see(stored->box_mm)) continue;
    const std::size_t count = prefix_length(stored->block->surfels.size(), detail_share);
    firsts_.push_back(static_cast<GLint>(stored->range.first));
    counts_.push_back(static_cast<GLsizei>(count));
    drawn += count;
  }
  if (drawn == 0) return 0;
  begin(store, eye, options, detail_share);
  glMultiDrawArrays(GL_POINTS, firsts_.data(), counts_.data(),
                    static_cast<GLsizei>(firsts_.size()));
  glDisable(GL_PROGRAM_POINT_SIZE);
  return drawn;
}

}  // namespace flytri::ui
