/// @file  A hidden window with OpenGL for tests that draw.
#pragma once

#include <memory>

struct GLFWwindow;

namespace flytri::testing {

/// An OpenGL 3.3 core context, current in this thread while the object exists.
class GlContext {
 public:
  /// Null without a display; a test that needs one is skipped with kNoDisplay.
  [[nodiscard]] static std::unique_ptr<GlContext> create();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  ~GlContext();

 private:
  explicit GlContext(GLFWwindow* window) : window_(window) {}
  GLFWwindow* window_;
};

}  // namespace flytri::testing
