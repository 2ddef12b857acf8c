/// @file  What differs between releases of Dear ImGui, from 1.86 to 1.92 (docs/adr/0011).
#pragma once

#include <imgui.h>

#include <cstdint>
#include <vector>

namespace flytri::ui {

/// The keys that are held, each of the kind on either side.
struct Modifiers {
  bool control = false, shift = false, alt = false;
};

/// The height of a line, px, for which a font was made.
[[nodiscard]] float font_size_px(const ImFont& font);
/// A font gets these characters from one that is merged, though its file has some of them, too.
/// @param ranges  first and last, pairs that end with 0; they must stay alive
void leave_out(ImFontConfig& font, const ImWchar* ranges);
/// To be called after all fonts were replaced. Frees what is in the texture only.
void replace_font_texture();
/// To be called before a frame is drawn. Fonts can grow while they are used.
void upload_fonts(const ImDrawData& data);

/// An OpenGL texture, as Dear ImGui takes it.
[[nodiscard]] ImTextureID texture_id(unsigned name);
/// The number of the texture that a command draws. The fonts must be uploaded.
[[nodiscard]] std::uint64_t texture_number(const ImDrawCmd& command);

/// Makes `data` draw these lists alone.
void set_lists(ImDrawData& data, std::vector<ImDrawList*>& lists);

/// Lets a frame take all events that it is given.
void prepare_keys(ImGuiIO& io);
/// @param key  by its GLFW name; Dear ImGui gets those that its text fields use
void set_key(ImGuiIO& io, int key, bool is_down);
void set_modifiers(ImGuiIO& io, const Modifiers& held);

}  // namespace flytri::ui
