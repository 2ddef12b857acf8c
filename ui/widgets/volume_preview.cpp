#include "ui/widgets/volume_preview.h"

#include <algorithm>

namespace flytri::ui {
namespace {

/// Shares of a depth by which it is drawn to the right and up.
constexpr double kObliqueRight = 0.35, kObliqueUp = 0.30;
/// Draws only every n-th point of a profile, as the picture is small.
constexpr std::size_t kPreviewStride = 12;

void draw_volume(const Theme& theme, const Rect& box, const Vec3& volume_mm) {
  const Vec3 half = volume_mm / 2.0;
  const auto corner = [&](int bits) {
    return place_in_preview(
        box, volume_mm,
        Vec3((bits & 1) != 0 ? half.x() : -half.x(), (bits & 2) != 0 ? half.y() : -half.y(),
             (bits & 4) != 0 ? half.z() : -half.z()));
  };
  const ImU32 color = to_u32(kHairline);
  for (int from = 0; from < 8; ++from) {
    for (const int bit : {1, 2, 4}) {
      if ((from & bit) != 0) continue;
      ImGui::GetWindowDrawList()->AddLine(corner(from), corner(from | bit), color, theme.px(1.0F));
    }
  }
}

void draw_view(const Theme& theme, const Rect& box, const Vec3& volume_mm, const View& view) {
  const ImU32 color =
      to_u32(view.pattern == Pattern::kVertical ? kVerticalProfile : kHorizontalProfile);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const Profile& profile : view.profiles) {
    for (std::size_t i = 0; i < profile.points.size(); i += kPreviewStride) {
      list.PathLineTo(place_in_preview(box, volume_mm, profile.points[i].position_mm));
    }
    list.PathStroke(color, 0, theme.px(1.5F));
  }
}

}  // namespace

ImVec2 place_in_preview(const Rect& box, const Vec3& volume_mm, const Vec3& point_mm) {
  const double width = volume_mm.x() + kObliqueRight * volume_mm.z();
  const double height = volume_mm.y() + kObliqueUp * volume_mm.z();
  const double factor =
      std::min(static_cast<double>(box.width) / width, static_cast<double>(box.height) / height);
  const ImVec2 middle = box.center();
  return {middle.x + static_cast<float>(factor * (point_mm.x() + kObliqueRight * point_mm.z())),
          middle.y + static_cast<float>(factor * (point_mm.y() - kObliqueUp * point_mm.z()))};
}

void volume_preview(const Theme& theme, const Rect& box, const Vec3& volume_mm,
                    const std::array<std::shared_ptr<const View>, 2>& views) {
  draw_box(box, kBackground, theme.px(kGapXs));
  const Rect inner = box.inset(theme.px(kGapS));
  draw_volume(theme, inner, volume_mm);
  for (const auto& view : views) {
    if (view != nullptr) draw_view(theme, inner, volume_mm, *view);
  }
}

}  // namespace flytri::ui
