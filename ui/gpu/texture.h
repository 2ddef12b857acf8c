/// @file  Images in graphics memory, and pictures drawn into them.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "ui/gpu/gl_object.h"
#include "ui/gpu/pixel_box.h"

namespace flytri::ui {

void delete_texture(GLuint name);
void delete_framebuffer(GLuint name);

/// A two-dimensional image. Its name is used as ImTextureID.
class Texture {
 public:
  Texture() = default;
  /// An empty one to draw into, such as GL_RGBA8 or GL_DEPTH_COMPONENT24.
  static Texture make(int width_px, int height_px, GLenum internal_format);

  /// Replaces the image; creates or resizes as needed. The first row is at v = 0.
  /// @param image  CV_8UC1 (shown grey), CV_16UC1 (likewise), or CV_8UC3 in R, G, B order
  void assign(const cv::Mat& image);
  void bind(int unit) const;

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  [[nodiscard]] GLuint name() const { return object_.name(); }

 private:
  GlObject<delete_texture> object_;
  int width_px_ = 0;
  int height_px_ = 0;
  GLenum internal_format_ = GL_RGBA8;
};

/// A drawing target. The textures must outlive it.
class Framebuffer {
 public:
  Framebuffer() = default;
  static Framebuffer make(const Texture& color, const Texture& depth);
  static Framebuffer make(const Texture& color);
  /// Makes it the target of all drawing, with its whole area.
  void bind() const;
  /// Copies a part of the color of another one, px from the lower left.
  void copy_color(const Framebuffer& from, const PixelBox& part) const;
  /// Copies a part of its color to another place of the framebuffer that is bound for drawing.
  /// @param to_px  new place of the lower left corner of the part
  void copy_to_bound(const PixelBox& part, const Eigen::Vector2i& to_px) const;
  /// Copies parts of its color to the same places of the window's own framebuffer, which stays
  /// bound.
  void copy_to_window(const std::vector<PixelBox>& parts) const;
  [[nodiscard]] PixelBox area() const;
  /// @return  its color: CV_8UC3, R, G, B order, first row at the top
  [[nodiscard]] cv::Mat read() const;
  /// Binds the framebuffer of the window again.
  static void bind_window();

 private:
  GlObject<delete_framebuffer> object_;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace flytri::ui
