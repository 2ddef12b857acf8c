#include "ui/widgets/hint.h"

#include "ui/widgets/draw_record.h"

namespace flytri::ui {
namespace {

void show(const std::string& text) {
  constexpr float kWidth = 22.0F;  // letters of full height
  if (text.empty()) return;
  if (DrawRecord* record = draw_record(); record != nullptr) record->hint = text;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kWidth * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

void hint_over(const Rect& box, const std::string& text) {
  const ImVec2 end = {box.right(), box.bottom()};
  if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(box.min(), end)) show(text);
}

void hint_over_item(const std::string& text) {
  if (ImGui::IsItemHovered()) show(text);
}

}  // namespace flytri::ui
