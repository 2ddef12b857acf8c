/// @file  The type of what a text field of Dear ImGui can undo.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

// From 1.92 its header declares it only.
#ifdef IMGUI_HAS_TEXTURES
#define IMSTB_TEXTEDIT_CHARTYPE char
namespace ImStb {
#include <imstb_textedit.h>
}
#endif
