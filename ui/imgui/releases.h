/// @file  What differs between releases of Dear ImGui, from 1.86 to 1.92 (docs/adr/0011).
#pragma once

#include <imgui.h>

#include <cstdint>
#include <vector>

namespace flytri::ui {

/// The modifier keys that are held, on either side of the keyboard.
struct Modifiers {
  bool control = false, shift = false, alt = false;
};

/// The height of a line, px, for which a font was made.
[[nodiscard]] float font_size_px(const ImFont& font);
/// Leaves these characters to the font that is merged into this one.
/// @param ranges  pairs of first and last, ended by 0; they must stay alive
void leave_out(ImFontConfig& font, const ImWchar* ranges);
/// Call it after all fonts were replaced.
void replace_font_texture();
/// Call it before a frame is drawn: from 1.92 on, fonts load characters when they are needed.
void upload_fonts(const ImDrawData& data);

/// An OpenGL texture, as Dear ImGui takes it.
[[nodiscard]] ImTextureID texture_id(unsigned name);
/// The number of the texture that a command draws. Call upload_fonts first.
[[nodiscard]] std::uint64_t texture_number(const ImDrawCmd& command);

/// Makes `data` draw these lists only. The lists must stay alive.
void set_lists(ImDrawData& data, std::vector<ImDrawList*>& lists);

/// Call it once. A frame then takes all key events that it is given.
void prepare_keys(ImGuiIO& io);
/// @param key  GLFW_KEY_*; Dear ImGui gets those that its text fields use
void set_key(ImGuiIO& io, int key, bool is_down);
void set_modifiers(ImGuiIO& io, const Modifiers& held);

}  // namespace flytri::ui
