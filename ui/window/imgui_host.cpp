#include "ui/window/imgui_host.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>

#include "ui/imgui/releases.h"
#include "ui/theme/palette.h"
#include "ui/widgets/pixel_rows.h"
#include "ui/widgets/typed_text.h"

namespace flytri::ui {
namespace {

/// As on common desktops. A slow picture takes a part of it.
constexpr float kDoubleClick_s = 0.5F;

/// Passes one event to Dear ImGui.
struct Feed {
  ImGuiIO& io;
  std::set<int>& held_keys;

  void operator()(const KeyEvent& event) const {
    if (event.is_down) held_keys.insert(event.key);
    if (!event.is_down) held_keys.erase(event.key);
    set_key(io, event.key, event.is_down);
    const auto either = [&](int left, int right) {
      return held_keys.contains(left) || held_keys.contains(right);
    };
    set_modifiers(io, {either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
                       either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
                       either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)});
  }
  void operator()(const CharacterEvent& event) const { io.AddInputCharacter(event.code); }
  void operator()(const PointerEvent& event) const { io.MousePos = {event.x_px, event.y_px}; }
  void operator()(const ButtonEvent& event) const {
    if (event.button < 0 || event.button >= IM_ARRAYSIZE(io.MouseDown)) return;
    io.MouseDown[event.button] = event.is_down;
  }
  void operator()(const WheelEvent& event) const {
    io.MouseWheelH += event.x;
    io.MouseWheel += event.y;
  }
};

const char* read_clipboard(void* window) {
  return glfwGetClipboardString(static_cast<GLFWwindow*>(window));
}
void write_clipboard(void* window, const char* text) {
  glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
}

}  // namespace

ImGuiHost::ImGuiHost(Window& window) : window_(window), context_(ImGui::CreateContext()) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendPlatformName = "flytri";
  io.GetClipboardTextFn = read_clipboard;
  io.SetClipboardTextFn = write_clipboard;
  io.ClipboardUserData = window.handle();
  io.MouseDoubleClickTime = kDoubleClick_s;
  prepare_keys(io);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

ImGuiHost::~ImGuiHost() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

Result<void> ImGuiHost::set_scale(float scale) {
  if (theme_.fonts.body != nullptr && theme_.scale == scale) return {};
  auto theme = make_theme(scale);
  if (!theme) return tl::unexpected(theme.error());
  theme_ = *theme;
  replace_font_texture();
  damage_.forget();
  return {};
}

std::vector<KeyEvent> ImGuiHost::begin_frame(const ImageSize& size, double now_s) {
  ImGuiIO& io = ImGui::GetIO();
  size_ = size;
  io.DisplaySize = {static_cast<float>(size.width_px), static_cast<float>(size.height_px)};
  io.DeltaTime =
      last_now_s_ < 0.0 ? 1.0F / 60.0F : std::max(static_cast<float>(now_s - last_now_s_), 1e-4F);
  last_now_s_ = now_s;
  std::vector<KeyEvent> presses;
  for (const InputEvent& event : window_.input().take_frame()) {
    const auto* key = std::get_if<KeyEvent>(&event);
    // Enter ends a line of text, and confirms the dialog in the same stroke.
    const bool is_text = io.WantTextInput && key != nullptr && key->key != GLFW_KEY_ENTER &&
                         key->key != GLFW_KEY_KP_ENTER;
    if (key != nullptr && key->is_down && !is_text) presses.push_back(*key);
    std::visit(Feed{io, held_keys_}, event);
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  return presses;
}

std::vector<PixelBox> ImGuiHost::end_frame(const std::vector<Rect>& repainted) {
  ImGui::Render();
  wipe_typed_text();
  ImDrawData& data = *ImGui::GetDrawData();
  upload_fonts(data);
  if (canvas_.resize(size_)) damage_.forget();
  const std::vector<Rect> boxes = damage_.update(data, repainted);
  canvas_.draw(data, boxes, kBackground);
  std::vector<PixelBox> changed;
  changed.reserve(boxes.size());
  for (const Rect& box : boxes) changed.push_back(from_below(box, data.DisplaySize.y));
  return changed;
}

}  // namespace flytri::ui
