#include "ui/theme/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "ui/imgui/releases.h"
#include "ui/theme/icons.h"
#include "ui/theme/palette.h"

namespace flytri::ui {
namespace {

constexpr float kMinimalWidth = 1024.0F;
constexpr float kMinimalHeight = 640.0F;
/// Icons in text are lowered by this share of their size: centered on capital letters.
constexpr float kIconDrop = 0.06F;

/// Path and package of each font on Debian.
struct FontFile {
  const char* path;
  const char* package;
};
constexpr FontFile kRegular = {"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "fonts-inter"};
constexpr FontFile kSemiBold = {"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
                                "fonts-inter"};
constexpr FontFile kBold = {"/usr/share/fonts/opentype/inter/Inter-Bold.otf", "fonts-inter"};
constexpr FontFile kIcons = {"/usr/share/fonts/truetype/font-awesome/fontawesome-webfont.ttf",
                             "fonts-font-awesome"};

/// Latin with all its accents, for names; Greek mu; dashes, quotes, arrows, signs.
constexpr std::array<ImWchar, 13> kTextGlyphs = {
    0x20, 0x24F, 0x394, 0x3C9, 0x2010, 0x2026, 0x2030, 0x203A, 0x2190, 0x2199, 0x2212, 0x2265, 0};
constexpr std::array<ImWchar, 3> kIconGlyphs = {kFirstIcon, kLastIcon, 0};

Result<void> check_fonts() {
  for (const FontFile& file : {kRegular, kSemiBold, kBold, kIcons}) {
    if (!std::filesystem::exists(file.path)) {
      return fail(ErrorCode::kNotFound, "{}: font not found; install it: apt-get install {}",
                  file.path, file.package);
    }
  }
  return {};
}

/// A text font with icons, slightly larger and lower so that they align with the text.
ImFont* add_font(const FontFile& file, float size_px) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig text;
  text.OversampleH = 2;
  text.PixelSnapH = true;
  leave_out(text, kIconGlyphs.data());
  ImFont* font = atlas.AddFontFromFileTTF(file.path, size_px, &text, kTextGlyphs.data());
  ImFontConfig icons;
  icons.MergeMode = true;
  icons.PixelSnapH = true;
  icons.GlyphOffset.y = std::round(size_px * kIconDrop);
  atlas.AddFontFromFileTTF(kIcons.path, std::round(size_px * 1.05F), &icons, kIconGlyphs.data());
  return font;
}

ImFont* add_icons(float size_px) {
  ImFontConfig icons;
  icons.PixelSnapH = true;
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(kIcons.path, size_px, &icons, kIconGlyphs.data());
}

void set_sizes(ImGuiStyle& style, const Theme& theme) {
  style.WindowPadding = {theme.px(kGapM), theme.px(kGapM)};
  style.FramePadding = {theme.px(12.0F), theme.px(10.0F)};
  style.ItemSpacing = {theme.px(kGapS), theme.px(kGapS)};
  style.ItemInnerSpacing = {theme.px(kGapS), theme.px(kGapXs)};
  style.WindowRounding = 0.0F;
  style.ChildRounding = theme.px(kRounding);
  style.PopupRounding = theme.px(kRounding);
  style.FrameRounding = theme.px(kRounding);
  style.GrabRounding = theme.px(kRounding);
  style.ScrollbarRounding = theme.px(kRounding);
  style.ScrollbarSize = theme.px(14.0F);
  style.GrabMinSize = theme.px(28.0F);
  style.WindowBorderSize = 0.0F;
  style.ChildBorderSize = 0.0F;
  style.PopupBorderSize = 0.0F;
  style.FrameBorderSize = 0.0F;
}

void set_colors(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  const auto set = [&](ImGuiCol which, const Color& color) {
    style.Colors[which] = to_vec4(color);
  };
  set(ImGuiCol_Text, kText);
  set(ImGuiCol_TextDisabled, kTextQuiet);
  set(ImGuiCol_WindowBg, kPanel);
  set(ImGuiCol_ChildBg, with_opacity(kPanel, 0.0F));
  set(ImGuiCol_PopupBg, kPanel);
  set(ImGuiCol_FrameBg, kRaised);
  set(ImGuiCol_FrameBgHovered, kRaisedHover);
  set(ImGuiCol_FrameBgActive, kRaisedActive);
  set(ImGuiCol_Button, kRaised);
  set(ImGuiCol_ButtonHovered, kRaisedHover);
  set(ImGuiCol_ButtonActive, kRaisedActive);
  set(ImGuiCol_Header, kRaised);
  set(ImGuiCol_HeaderHovered, kRaisedHover);
  set(ImGuiCol_HeaderActive, kRaisedActive);
  set(ImGuiCol_SliderGrab, kNeutral);
  set(ImGuiCol_SliderGrabActive, kNeutral);
  set(ImGuiCol_CheckMark, kNeutral);
  set(ImGuiCol_Separator, kHairline);
  set(ImGuiCol_ScrollbarBg, with_opacity(kPanel, 0.0F));
  set(ImGuiCol_ScrollbarGrab, kRaisedActive);
  set(ImGuiCol_TextSelectedBg, with_opacity(kNeutral, 0.45F));
}

/// From this many units on, texts grow with the window: it fills a large screen, which is seen from
/// farther away.
constexpr double kRoomyWidth = 1600.0, kRoomyHeight = 1000.0, kMostGrowth = 1.5;

}  // namespace

float Theme::px(float units) const { return std::round(units * scale); }

float window_scale(double content_scale, double user_scale, int width_px, int height_px) {
  const float largest = std::min({static_cast<float>(width_px) / kMinimalWidth,
                                  static_cast<float>(height_px) / kMinimalHeight, 4.0F});
  const double room = std::min(width_px / kRoomyWidth, height_px / kRoomyHeight) / content_scale;
  const double growth = std::clamp(room, 1.0, kMostGrowth);
  const float wanted = std::min(static_cast<float>(content_scale * user_scale * growth), largest);
  return std::max(std::floor(wanted * 8.0F) / 8.0F, 0.5F);
}

Result<Theme> make_theme(float scale) {
  if (auto checked = check_fonts(); !checked) return tl::unexpected(checked.error());
  ImGui::GetIO().Fonts->Clear();
  Theme theme;
  theme.scale = scale;
  theme.fonts.body = add_font(kRegular, theme.px(16.0F));
  theme.fonts.small = add_font(kRegular, theme.px(13.0F));
  theme.fonts.strong = add_font(kSemiBold, theme.px(16.0F));
  theme.fonts.title = add_font(kSemiBold, theme.px(22.0F));
  theme.fonts.status = add_font(kBold, theme.px(30.0F));
  theme.fonts.icon = add_icons(theme.px(26.0F));
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_sizes(style, theme);
  set_colors(style);
  return theme;
}

}  // namespace flytri::ui
