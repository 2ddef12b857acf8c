/// @file  What was drawn in the latest frame, as far as tests ask: what lies where, what was cut.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "ui/widgets/rect.h"

namespace flytri::ui {

/// A plate over the scene, by its name.
struct OverlayPlace {
  std::string id;
  Rect box;
};

struct DrawRecord {
  std::vector<OverlayPlace> overlays;
  std::vector<std::string> cut_texts;  ///< whole, as they were before they were cut

  void clear() { *this = {}; }
};

/// Gives the record to all that is drawn in the current context of Dear ImGui; it must outlive it.
inline void record_drawing(DrawRecord& record) { ImGui::GetIO().UserData = &record; }

/// @return  null where nobody wants it
inline DrawRecord* draw_record() { return static_cast<DrawRecord*>(ImGui::GetIO().UserData); }

}  // namespace flytri::ui
