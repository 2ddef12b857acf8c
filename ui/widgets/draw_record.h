/// @file  Records for tests what the latest frame shows: positions of overlays, cut texts, the
/// hint.
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
  /// The whole texts of those that were cut, or that do not fit into their box.
  std::vector<std::string> cut_texts;
  std::string hint;  ///< shown beside the pointer; empty: none

  void clear() { *this = {}; }
};

/// Starts recording in the current context of Dear ImGui; the record must outlive it.
inline void record_drawing(DrawRecord& record) { ImGui::GetIO().UserData = &record; }

/// @return  null if nothing is recorded
inline DrawRecord* draw_record() { return static_cast<DrawRecord*>(ImGui::GetIO().UserData); }

}  // namespace flytri::ui
