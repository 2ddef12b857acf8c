#include "tests/support/gl_context.h"

// Include epoxy before GLFW, which would otherwise include its own OpenGL headers.
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

}  // namespace flytri::testing
