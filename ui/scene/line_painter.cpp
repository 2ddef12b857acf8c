#include "ui/scene/line_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace flytri::ui {
namespace {

/// One of the four corners of a line; each holds the whole line.
struct LineCorner {
  Vec3f from_mm;
  float width_px;
  Vec3f to_mm;
  std::array<std::uint8_t, 4> color;
  std::array<std::int8_t, 4> corner;  ///< along, across; the others are padding
};

std::array<std::uint8_t, 4> bytes_of(const Color& color) {
  std::array<std::uint8_t, 4> bytes{};
  for (std::size_t c = 0; c < bytes.size(); ++c) {
    bytes[c] = static_cast<std::uint8_t>(std::lround(color[c] * 255.0F));
  }
  return bytes;
}

/// Those that show through the model come first.
std::vector<LineCorner> corners_of_lines(const std::vector<OverlayLine>& lines) {
  std::vector<LineCorner> corners;
  corners.reserve(4 * lines.size());
  const auto add = [&](const OverlayLine& line) {
    LineCorner at{line.from_mm, line.width_px, line.to_mm, bytes_of(line.color), {}};
    for (const std::int8_t along : {-1, 1}) {
      for (const std::int8_t across : {-1, 1}) {
        at.corner = {along, across, 0, 0};
        corners.push_back(at);
      }
    }
  };
  for (const OverlayLine& line : lines) {
    if (line.shows_through) add(line);
  }
  for (const OverlayLine& line : lines) {
    if (!line.shows_through) add(line);
  }
  return corners;
}

/// Two triangles a line.
std::vector<std::uint32_t> indices_of(std::size_t line_count) {
  std::vector<std::uint32_t> indices;
  indices.reserve(6 * line_count);
  for (std::uint32_t first = 0; first < 4 * line_count; first += 4) {
    for (const std::uint32_t corner : {0U, 1U, 2U, 2U, 1U, 3U}) indices.push_back(first + corner);
  }
  return indices;
}

std::array<Attribute, 4> line_attributes() {
  return {{{0, 4, GL_FLOAT, false, offsetof(LineCorner, from_mm)},
           {1, 3, GL_FLOAT, false, offsetof(LineCorner, to_mm)},
           {2, 4, GL_UNSIGNED_BYTE, true, offsetof(LineCorner, color)},
           {3, 2, GL_BYTE, false, offsetof(LineCorner, corner)}}};
}

}  // namespace

Result<LinePainter> LinePainter::create() {
  Result<ShaderProgram> program = ShaderProgram::load("line.vert", "line.frag");
  if (!program) return tl::unexpected(program.error());
  return LinePainter(std::move(*program));
}

LinePainter::LinePainter(ShaderProgram program)
    : program_(std::move(program)),
      corners_(Buffer::make(GL_ARRAY_BUFFER, 0, GL_STREAM_DRAW)),
      indices_(Buffer::make(GL_ARRAY_BUFFER, 0, GL_STATIC_DRAW)),
      vertices_(VertexArray::make()) {
  vertices_.attach(corners_, sizeof(LineCorner), line_attributes());
  vertices_.attach_indices(indices_);
}

void LinePainter::paint(const std::vector<OverlayLine>& lines, const Eye& eye) {
  /// Lines on the surface are drawn in front of it by this share of the picture's height.
  constexpr double kLift = 0.004;
  /// Lines that do not show through run along the border of the surface, whose splats bulge.
  constexpr double kRimLift = 0.02;
  constexpr float kHiddenOpacity = 0.35F;
  if (lines.empty()) return;
  const std::vector<LineCorner> corners = corners_of_lines(lines);
  corners_.assign(std::as_bytes(std::span(corners)));
  if (lines.size() > indexed_lines_) {
    indexed_lines_ = 2 * lines.size();
    const std::vector<std::uint32_t> indices = indices_of(indexed_lines_);
    indices_.assign(std::as_bytes(std::span(indices)));
  }
  program_.use();
  program_.set("P_clip_world", eye.P_clip_world);
  program_.set("size_px", eye.size_px());
  vertices_.bind();
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  const auto through = static_cast<std::size_t>(std::count_if(
      lines.begin(), lines.end(), [](const OverlayLine& line) { return line.shows_through; }));
  const auto draw = [&](GLenum depth_function, float opacity, double lift, std::size_t first,
                        std::size_t end) {
    glDepthFunc(depth_function);
    program_.set("opacity", opacity);
    program_.set("towards_eye", static_cast<float>(lift * eye.height_mm) * eye.depth_per_mm());
    // OpenGL takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* offset = reinterpret_cast<const void*>(6 * first * sizeof(std::uint32_t));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * (end - first)), GL_UNSIGNED_INT, offset);
  };
  draw(GL_GREATER, kHiddenOpacity, kLift, 0, through);
  draw(GL_LEQUAL, 1.0F, kLift, 0, through);
  draw(GL_LEQUAL, 1.0F, kRimLift, through, lines.size());
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
}

}  // namespace flytri::ui
