#include "ui/gpu/texture.h"

#include <cassert>
#include <opencv2/core.hpp>

namespace flytri::ui {
namespace {

struct PixelFormat {
  GLenum internal_format, format, type;
};

PixelFormat format_of(const cv::Mat& image) {
  switch (image.type()) {
    case CV_8UC1:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
    case CV_16UC1:
      return {GL_R16, GL_RED, GL_UNSIGNED_SHORT};
    default:
      assert(image.type() == CV_8UC3);
      return {GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE};
  }
}

PixelFormat empty_format(GLenum internal_format) {
  if (internal_format == GL_DEPTH_COMPONENT24) {
    return {internal_format, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
  }
  // Blue first, as in windows: Mesa then copies without conversion.
  return {internal_format, GL_BGRA, GL_UNSIGNED_BYTE};
}

void set_filter(GLint filter) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// Copies from the read framebuffer to the draw framebuffer; `to` is the new lower left corner.
void blit(const PixelBox& part, const Eigen::Vector2i& to) {
  const Eigen::Vector2i end = part.max() + Eigen::Vector2i::Ones(), to_end = to + end - part.min();
  glBlitFramebuffer(part.min().x(), part.min().y(), end.x(), end.y(), to.x(), to.y(), to_end.x(),
                    to_end.y(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

GlObject<delete_texture> new_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return GlObject<delete_texture>(name);
}

}  // namespace

void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }

Texture Texture::make(int width_px, int height_px, GLenum internal_format) {
  Texture texture;
  texture.object_ = new_texture();
  texture.width_px_ = width_px;
  texture.height_px_ = height_px;
  texture.internal_format_ = internal_format;
  const PixelFormat format = empty_format(internal_format);
  texture.bind(0);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal_format), width_px, height_px, 0,
               format.format, format.type, nullptr);
  set_filter(GL_NEAREST);
  return texture;
}

void Texture::assign(const cv::Mat& image) {
  const PixelFormat format = format_of(image);
  if (object_.name() == 0) object_ = new_texture();
  bind(0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(image.step1() / image.channels()));
  const bool fits = image.cols == width_px_ && image.rows == height_px_ &&
                    internal_format_ == format.internal_format;
  if (fits) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.cols, image.rows, format.format, format.type,
                    image.data);
  } else {
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), image.cols,
                 image.rows, 0, format.format, format.type, image.data);
    set_filter(GL_LINEAR);
    const GLint grey[] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    const GLint color[] = {GL_RED, GL_GREEN, GL_BLUE, GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, image.channels() == 1 ? grey : color);
    width_px_ = image.cols;
    height_px_ = image.rows;
    internal_format_ = format.internal_format;
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void Texture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, name());
}

Framebuffer Framebuffer::make(const Texture& color) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  Framebuffer framebuffer;
  framebuffer.object_ = GlObject<delete_framebuffer>(name);
  framebuffer.width_px_ = color.width_px();
  framebuffer.height_px_ = color.height_px();
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color.name(), 0);
  bind_window();
  return framebuffer;
}

Framebuffer Framebuffer::make(const Texture& color, const Texture& depth) {
  Framebuffer framebuffer = make(color);
  framebuffer.bind();
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.name(), 0);
  assert(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  bind_window();
  return framebuffer;
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, object_.name());
  glViewport(0, 0, width_px_, height_px_);
}

void Framebuffer::copy_color(const Framebuffer& from, const PixelBox& part) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.object_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, object_.name());
  blit(part, part.min());
}

void Framebuffer::copy_to_bound(const PixelBox& part, const Eigen::Vector2i& to_px) const {
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, object_.name());
  blit(part, to_px);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
}

void Framebuffer::copy_to_window(const std::vector<PixelBox>& parts) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, object_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  for (const PixelBox& part : parts) blit(part, part.min());
  bind_window();
}

PixelBox Framebuffer::area() const {
  return {Eigen::Vector2i(0, 0), Eigen::Vector2i(width_px_ - 1, height_px_ - 1)};
}

cv::Mat Framebuffer::read() const {
  cv::Mat pixels(height_px_, width_px_, CV_8UC3);
  glBindFramebuffer(GL_FRAMEBUFFER, object_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_px_, height_px_, GL_RGB, GL_UNSIGNED_BYTE, pixels.data);
  bind_window();
  cv::Mat upright;
  cv::flip(pixels, upright, 0);  // OpenGL's first row is at the bottom.
  return upright;
}

void Framebuffer::bind_window() { glBindFramebuffer(GL_FRAMEBUFFER, 0); }

}  // namespace flytri::ui
