#include "ui/window/canvas.h"

#include <backends/imgui_impl_opengl3.h>

#include "ui/imgui/releases.h"
#include "ui/widgets/pixel_rows.h"

namespace flytri::ui {
namespace {

/// While it exists, all clip rectangles of a frame are limited to a box.
class Narrowed {
 public:
  Narrowed(ImDrawData& data, const Rect& box) : data_(data) {
    for_each([&](ImVec4& clip) {
      kept_.push_back(clip);
      clip = {std::max(clip.x, box.x), std::max(clip.y, box.y), std::min(clip.z, box.right()),
              std::min(clip.w, box.bottom())};
    });
  }
  ~Narrowed() {
    auto kept = kept_.begin();
    for_each([&](ImVec4& clip) { clip = *kept++; });
  }
  Narrowed(const Narrowed&) = delete;
  Narrowed& operator=(const Narrowed&) = delete;

 private:
  template <typename Do>
  void for_each(const Do& change) {
    for (int i = 0; i < data_.CmdListsCount; ++i) {
      for (ImDrawCmd& command : data_.CmdLists[i]->CmdBuffer) change(command.ClipRect);
    }
  }

  ImDrawData& data_;
  std::vector<ImVec4> kept_;
};

/// Only the lists that draw something within the box.
std::vector<ImDrawList*> reaching(const ImDrawData& data) {
  std::vector<ImDrawList*> lists;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const auto& commands = data.CmdLists[i]->CmdBuffer;
    const bool draws = std::any_of(commands.begin(), commands.end(), [](const ImDrawCmd& command) {
      return command.ClipRect.x < command.ClipRect.z && command.ClipRect.y < command.ClipRect.w;
    });
    if (draws) lists.push_back(data.CmdLists[i]);
  }
  return lists;
}

void clear(const PixelBox& box, const Color& color) {
  glEnable(GL_SCISSOR_TEST);
  const Eigen::Vector2i size = box.sizes() + Eigen::Vector2i::Ones();
  glScissor(box.min().x(), box.min().y(), size.x(), size.y());
  glClearColor(color[0], color[1], color[2], 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace

bool Canvas::resize(const ImageSize& size) {
  if (picture_.width_px() == size.width_px && picture_.height_px() == size.height_px) return false;
  picture_ = Texture::make(size.width_px, size.height_px, GL_RGBA8);
  framebuffer_ = Framebuffer::make(picture_);
  return true;
}

void Canvas::draw(ImDrawData& data, const std::vector<Rect>& boxes, const Color& background) {
  framebuffer_.bind();
  for (const Rect& box : boxes) {
    clear(from_below(box, data.DisplaySize.y), background);
    const Narrowed narrowed(data, box);
    std::vector<ImDrawList*> lists = reaching(data);
    ImDrawData part = data;
    set_lists(part, lists);
    ImGui_ImplOpenGL3_RenderDrawData(&part);
  }
  Framebuffer::bind_window();
}

}  // namespace flytri::ui
