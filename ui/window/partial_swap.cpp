#include "ui/window/partial_swap.h"

#include <epoxy/gl.h>
// After epoxy's first header.
#include <epoxy/glx.h>

#include <string_view>

namespace flytri::ui {
namespace {

/// Recognizes the software renderers of Mesa by name.
bool is_drawn_by_processor() {
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = text == nullptr ? "" : text;
  return renderer.find("llvmpipe") != renderer.npos || renderer.find("softpipe") != renderer.npos;
}

}  // namespace

std::optional<PartialSwap> PartialSwap::find() {
  Display* display = glXGetCurrentDisplay();
  const GLXDrawable drawable = glXGetCurrentDrawable();
  if (display == nullptr || drawable == None || !is_drawn_by_processor()) return std::nullopt;
  if (!epoxy_has_glx_extension(display, DefaultScreen(display), "GLX_MESA_copy_sub_buffer")) {
    return std::nullopt;
  }
  return PartialSwap(display, drawable);
}

void PartialSwap::show(const PixelBox& part) const {
  const Eigen::Vector2i size = part.sizes() + Eigen::Vector2i::Ones();
  glXCopySubBufferMESA(static_cast<Display*>(display_), drawable_, part.min().x(), part.min().y(),
                       size.x(), size.y());
}

}  // namespace flytri::ui
