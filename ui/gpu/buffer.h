/// @file  A buffer of the graphics memory, and how vertices are read from it.
#pragma once

#include <cstddef>
#include <span>

#include "ui/gpu/gl_object.h"

namespace flytri::ui {

void delete_buffer(GLuint name);
void delete_vertex_array(GLuint name);

/// Bytes in graphics memory.
class Buffer {
 public:
  Buffer() = default;
  /// `size_bytes` of undefined content.
  static Buffer make(GLenum target, std::size_t size_bytes, GLenum usage = GL_DYNAMIC_DRAW);

  /// Replaces the whole content; grows as needed.
  void assign(std::span<const std::byte> bytes);
  /// Writes a part. The range must lie inside.
  void write(std::size_t offset_bytes, std::span<const std::byte> bytes);
  /// A buffer of another size that starts with this one's content.
  [[nodiscard]] Buffer resized(std::size_t size_bytes) const;
  void bind() const;

  [[nodiscard]] std::size_t size_bytes() const { return size_bytes_; }
  [[nodiscard]] GLuint name() const { return object_.name(); }

 private:
  GlObject<delete_buffer> object_;
  GLenum target_ = GL_ARRAY_BUFFER;
  GLenum usage_ = GL_DYNAMIC_DRAW;
  std::size_t size_bytes_ = 0;
};

/// One attribute of a vertex.
struct Attribute {
  GLuint location = 0;
  GLint components = 1;
  GLenum type = GL_FLOAT;
  bool is_normalized = false;  ///< integers are read as 0..1 or -1..1
  std::size_t offset_bytes = 0;
  GLuint divisor = 0;  ///< 1: one per instance
};

class VertexArray {
 public:
  VertexArray() = default;
  static VertexArray make();
  void bind() const;
  /// Reads the attributes from `buffer`, one vertex every `stride_bytes`.
  void attach(const Buffer& buffer, std::size_t stride_bytes,
              std::span<const Attribute> attributes) const;
  /// Takes triangle indices from `buffer`.
  void attach_indices(const Buffer& buffer) const;

 private:
  explicit VertexArray(GLuint name) : object_(name) {}
  GlObject<delete_vertex_array> object_;
};

}  // namespace flytri::ui
