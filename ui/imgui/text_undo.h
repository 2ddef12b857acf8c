/// @file  The undo history of a text field of Dear ImGui.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

// From 1.92 on, imgui_internal.h only declares it.
#ifdef IMGUI_HAS_TEXTURES
#define IMSTB_TEXTEDIT_CHARTYPE char
namespace ImStb {
#include <imstb_textedit.h>
}
#endif
