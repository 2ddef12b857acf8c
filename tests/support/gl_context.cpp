#include "tests/support/gl_context.h"

// epoxy comes before GLFW, which would bring OpenGL headers of its own.
#include <epoxy/gl.h>
// clang-format off
#include <GLFW/glfw3.h>
// clang-format on

namespace flytri::testing {

std::unique_ptr<GlContext> GlContext::create() {
  if (glfwInit() == GLFW_FALSE) return nullptr;
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  GLFWwindow* window = glfwCreateWindow(64, 64, "flytri test", nullptr, nullptr);
  if (window == nullptr) return nullptr;
  glfwMakeContextCurrent(window);
  return std::unique_ptr<GlContext>(new GlContext(window));
}

GlContext::~GlContext() {
  glfwMakeContextCurrent(nullptr);
  glfwDestroyWindow(window_);
}

cv::Mat read_texture(unsigned texture, int width_px, int height_px) {
  cv::Mat upside_down(height_px, width_px, CV_8UC3);
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data);
  cv::Mat upright;
  cv::flip(upside_down, upright, 0);
  return upright;
}

}  // namespace flytri::testing
