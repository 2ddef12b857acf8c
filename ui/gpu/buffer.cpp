#include "ui/gpu/buffer.h"

#include <algorithm>
#include <cassert>

namespace flytri::ui {
namespace {

/// Pointers of OpenGL are offsets into the bound buffer.
const void* as_pointer(std::size_t offset) {
  return reinterpret_cast<const void*>(offset);  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace

void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }

Buffer Buffer::make(GLenum target, std::size_t size_bytes, GLenum usage) {
  GLuint name = 0;
  glGenBuffers(1, &name);
  Buffer buffer;
  buffer.object_ = GlObject<delete_buffer>(name);
  buffer.target_ = target;
  buffer.usage_ = usage;
  buffer.size_bytes_ = size_bytes;
  buffer.bind();
  glBufferData(target, static_cast<GLsizeiptr>(size_bytes), nullptr, usage);
  return buffer;
}

void Buffer::assign(std::span<const std::byte> bytes) {
  bind();
  if (bytes.size() > size_bytes_) size_bytes_ = bytes.size() + bytes.size() / 2;
  // New memory: pictures that are still being drawn keep the old one.
  glBufferData(target_, static_cast<GLsizeiptr>(size_bytes_), nullptr, usage_);
  glBufferSubData(target_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::write(std::size_t offset_bytes, std::span<const std::byte> bytes) {
  assert(offset_bytes + bytes.size() <= size_bytes_);
  bind();
  glBufferSubData(target_, static_cast<GLintptr>(offset_bytes),
                  static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

Buffer Buffer::resized(std::size_t size_bytes) const {
  Buffer larger = make(target_, size_bytes, usage_);
  glBindBuffer(GL_COPY_READ_BUFFER, name());
  glBindBuffer(GL_COPY_WRITE_BUFFER, larger.name());
  glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                      static_cast<GLsizeiptr>(std::min(size_bytes, size_bytes_)));
  return larger;
}

void Buffer::bind() const { glBindBuffer(target_, name()); }

VertexArray VertexArray::make() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

void VertexArray::bind() const { glBindVertexArray(object_.name()); }

void VertexArray::attach(const Buffer& buffer, std::size_t stride_bytes,
                         std::span<const Attribute> attributes) const {
  bind();
  glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
  for (const Attribute& a : attributes) {
    glEnableVertexAttribArray(a.location);
    glVertexAttribPointer(a.location, a.components, a.type, a.is_normalized ? GL_TRUE : GL_FALSE,
                          static_cast<GLsizei>(stride_bytes), as_pointer(a.offset_bytes));
    glVertexAttribDivisor(a.location, a.divisor);
  }
}

void VertexArray::attach_indices(const Buffer& buffer) const {
  bind();
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.name());
}

}  // namespace flytri::ui
