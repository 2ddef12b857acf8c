#include "ui/scene/mesh_painter.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "ui/scene/coloring.h"
#include "ui/scene/vertex_format.h"

namespace flytri::ui {
namespace {

/// A vertex in graphics memory: 32 bytes.
struct MeshVertex {
  Vec3f position_mm;
  std::uint32_t normal;
  Eigen::Vector2f uv;
  std::uint32_t color_flags;
  float value_mm;  ///< uncertainty, clearance, or depth of undercut
};

std::array<Attribute, 5> mesh_attributes() {
  return {{{0, 3, GL_FLOAT, false, offsetof(MeshVertex, position_mm)},
           {1, 4, GL_INT_2_10_10_10_REV, true, offsetof(MeshVertex, normal)},
           {2, 2, GL_FLOAT, false, offsetof(MeshVertex, uv)},
           {3, 4, GL_UNSIGNED_BYTE, true, offsetof(MeshVertex, color_flags)},
           {4, 1, GL_FLOAT, false, offsetof(MeshVertex, value_mm)}}};
}

float value_of(const SurfacePoint& vertex, std::size_t index, const MeshPainter::Marks& marks) {
  if (marks.undercut) return (*marks.undercut->depth_mm)[index];
  if (!marks.jaws) return vertex.sigma_mm;
  // Graphics cards need not know NaN.
  const float clearance_mm = (*marks.jaws->clearance_mm)[index];
  return std::isnan(clearance_mm) ? std::numeric_limits<float>::max() : clearance_mm;
}

std::vector<MeshVertex> vertices_of(const TexturedMesh& mesh, const MeshPainter::Marks& marks) {
  std::vector<MeshVertex> vertices;
  vertices.reserve(mesh.mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.mesh.vertices.size(); ++i) {
    const SurfacePoint& v = mesh.mesh.vertices[i];
    unsigned flags = marks.coverage[i] == Coverage::kGood ? kGoodFlag : 0U;
    flags |= tint_flag(marks.tints, v.position_mm, v.normal);
    if (std::isinf(v.sigma_mm)) flags |= kNotMeasuredFlag;
    if (marks.jaws && i >= marks.jaws->first_lower) flags |= kLowerJawFlag;
    vertices.push_back({v.position_mm, packed_normal(v.normal),
                        mesh.uv.empty() ? Eigen::Vector2f(0.0F, 0.0F) : mesh.uv[i],
                        packed_color(v.color, static_cast<std::uint8_t>(flags)),
                        value_of(v, i, marks)});
  }
  return vertices;
}

}  // namespace

Result<MeshPainter> MeshPainter::create() {
  Result<ShaderProgram> program = ShaderProgram::load("mesh.vert", "mesh.frag");
  if (!program) return tl::unexpected(program.error());
  return MeshPainter(std::move(*program));
}

MeshPainter::MeshPainter(ShaderProgram program)
    : program_(std::move(program)),
      buffer_(Buffer::make(GL_ARRAY_BUFFER, 0, GL_STATIC_DRAW)),
      indices_(Buffer::make(GL_ARRAY_BUFFER, 0, GL_STATIC_DRAW)),
      vertices_(VertexArray::make()) {
  vertices_.attach(buffer_, sizeof(MeshVertex), mesh_attributes());
  vertices_.attach_indices(indices_);
}

void MeshPainter::take(const TexturedMesh& mesh, const Marks& marks) {
  mark(mesh, marks);
  indices_.assign(std::as_bytes(std::span(mesh.mesh.triangles)));
  index_count_ = static_cast<GLsizei>(3 * mesh.mesh.triangles.size());
  has_atlas_ = !mesh.uv.empty() && !mesh.atlas.empty();
  if (has_atlas_) atlas_.assign(mesh.atlas);
  box_mm_.setEmpty();
  for (const SurfacePoint& v : mesh.mesh.vertices) box_mm_.extend(v.position_mm.cast<double>());
}

void MeshPainter::mark(const TexturedMesh& mesh, const Marks& marks) {
  const std::vector<MeshVertex> vertices = vertices_of(mesh, marks);
  buffer_.assign(std::as_bytes(std::span(vertices)));
}

void MeshPainter::paint(const Eye& eye, const SceneOptions& options) const {
  if (index_count_ == 0) return;
  program_.use();
  eye.set_uniforms(program_);
  set_coloring(program_, options);
  program_.set("T_open_closed", Eigen::Matrix4f(options.T_open_closed.matrix().cast<float>()));
  program_.set("atlas", 0);
  program_.set("has_atlas", has_atlas_ ? 1 : 0);
  if (has_atlas_) atlas_.bind(0);
  vertices_.bind();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_CULL_FACE);
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
}

}  // namespace flytri::ui
