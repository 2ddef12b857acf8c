#include "ui/imgui/releases.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <array>
#include <type_traits>

namespace flytri::ui {
namespace {

struct KeyName {
  int glfw;
  ImGuiKey imgui;
};
/// The keys that the text fields of Dear ImGui use.
constexpr std::array<KeyName, 17> kKeys = {{
    {GLFW_KEY_TAB, ImGuiKey_Tab},
    {GLFW_KEY_LEFT, ImGuiKey_LeftArrow},
    {GLFW_KEY_RIGHT, ImGuiKey_RightArrow},
    {GLFW_KEY_UP, ImGuiKey_UpArrow},
    {GLFW_KEY_DOWN, ImGuiKey_DownArrow},
    {GLFW_KEY_HOME, ImGuiKey_Home},
    {GLFW_KEY_END, ImGuiKey_End},
    {GLFW_KEY_DELETE, ImGuiKey_Delete},
    {GLFW_KEY_BACKSPACE, ImGuiKey_Backspace},
    {GLFW_KEY_ENTER, ImGuiKey_Enter},
    {GLFW_KEY_ESCAPE, ImGuiKey_Escape},
    {GLFW_KEY_A, ImGuiKey_A},
    {GLFW_KEY_C, ImGuiKey_C},
    {GLFW_KEY_V, ImGuiKey_V},
    {GLFW_KEY_X, ImGuiKey_X},
    {GLFW_KEY_Y, ImGuiKey_Y},
    {GLFW_KEY_Z, ImGuiKey_Z},
}};

// Where only types and members differ, templates take what is there.

template <typename Font>
float size_of(const Font& font) {
  if constexpr (requires { font.FontSize; }) {
    return font.FontSize;
  } else {
    return font.LegacySize;
  }
}

template <typename Config>
void exclude(Config& font, const ImWchar* ranges) {
  if constexpr (requires { font.GlyphExcludeRanges; }) font.GlyphExcludeRanges = ranges;
}

template <typename Id>
Id id_of(unsigned name) {
  if constexpr (std::is_pointer_v<Id>) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the number of a texture is passed as a pointer
    return reinterpret_cast<Id>(static_cast<std::uintptr_t>(name));
  } else {
    return name;
  }
}

template <typename Id>
std::uint64_t number_of(Id id) {
  if constexpr (std::is_pointer_v<Id>) {
    return reinterpret_cast<std::uintptr_t>(id);
  } else {
    return id;
  }
}

/// An array of lists up to 1.89.7, a vector later.
template <typename Kept>
void keep(Kept& kept, std::vector<ImDrawList*>& lists) {
  if constexpr (std::is_pointer_v<Kept>) {
    kept = lists.data();
  } else {
    kept.resize(static_cast<int>(lists.size()));
    std::copy(lists.begin(), lists.end(), kept.begin());
  }
}

}  // namespace

float font_size_px(const ImFont& font) { return size_of(font); }

void leave_out(ImFontConfig& font, const ImWchar* ranges) { exclude(font, ranges); }

ImTextureID texture_id(unsigned name) { return id_of<ImTextureID>(name); }

std::uint64_t texture_number(const ImDrawCmd& command) { return number_of(command.GetTexID()); }

void set_lists(ImDrawData& data, std::vector<ImDrawList*>& lists) {
  keep(data.CmdLists, lists);
  data.CmdListsCount = static_cast<int>(lists.size());
}

// Where functions and constants differ, only the preprocessor can tell.
#ifdef IMGUI_HAS_TEXTURES  // from 1.92

void replace_font_texture() {}

void upload_fonts(const ImDrawData& data) {
  if (data.Textures == nullptr) return;
  for (ImTextureData* texture : *data.Textures) {
    if (texture->Status != ImTextureStatus_OK) ImGui_ImplOpenGL3_UpdateTexture(texture);
  }
}

void prepare_keys(ImGuiIO& io) { io.ConfigInputTrickleEventQueue = false; }

void set_key(ImGuiIO& io, int key, bool is_down) {
  const auto* named = std::find_if(kKeys.begin(), kKeys.end(),
                                   [&](const KeyName& each) { return each.glfw == key; });
  if (named != kKeys.end()) io.AddKeyEvent(named->imgui, is_down);
}

void set_modifiers(ImGuiIO& io, const Modifiers& held) {
  io.AddKeyEvent(ImGuiMod_Ctrl, held.control);
  io.AddKeyEvent(ImGuiMod_Shift, held.shift);
  io.AddKeyEvent(ImGuiMod_Alt, held.alt);
}

#else

void replace_font_texture() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  ImGui::GetIO().Fonts->ClearTexData();  // some 40 MB, now in the texture
}

void upload_fonts(const ImDrawData& /*data*/) {}

void prepare_keys(ImGuiIO& io) {
  for (const KeyName& key : kKeys) io.KeyMap[key.imgui] = key.glfw;
}

void set_key(ImGuiIO& io, int key, bool is_down) {
  if (key >= 0 && key < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[key] = is_down;
}

void set_modifiers(ImGuiIO& io, const Modifiers& held) {
  io.KeyCtrl = held.control;
  io.KeyShift = held.shift;
  io.KeyAlt = held.alt;
}

#endif

}  // namespace flytri::ui
