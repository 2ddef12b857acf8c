#include "ui/panels/review_input.h"

namespace flytri::ui {
namespace {

void click_distance(const PanelContext& context, const Vec3& p_mm) {
  auto& from = context.state.measured_from_mm;
  if (!from) {
    from = p_mm;
    return;
  }
  context.commands.emplace_back(AddMeasurement{{0, *from, p_mm, {}}});
  from.reset();
}

void click_angle(const PanelContext& context, const Vec3& p_mm) {
  std::vector<Vec3>& points_mm = context.state.review.angle_mm;
  points_mm.push_back(p_mm);
  if (points_mm.size() < 3) return;
  context.commands.emplace_back(MeasureAngle{{points_mm[0], points_mm[1], points_mm[2]}});
  points_mm.clear();
}

void click_margin(const PanelContext& context, const Vec3& p_mm) {
  std::vector<Vec3>& points_mm = context.state.review.margin_mm;
  points_mm.push_back(p_mm);
  context.commands.emplace_back(DrawMargin{points_mm});
}

void click_undercut(const PanelContext& context, const Vec3& p_mm) {
  context.state.review.around_mm = p_mm;
  ask_for_undercut(context, std::nullopt);
}

/// The plane holds the line of sight and the vertical of the picture, as of the first moment.
void cut(const PanelContext& context, const Vec3& p_mm, bool is_first) {
  ReviewForm& form = context.state.review;
  const Vec3 across = context.state.view.camera.T_world_eye().linear().col(0);
  const Vec3 normal = form.plane && !is_first ? form.plane->normal : across;
  if (form.plane && form.plane->point_mm == p_mm && form.plane->normal == normal) return;
  form.plane = review::Plane{p_mm, normal};
  form.section_mm.clear();
  context.commands.emplace_back(CutSection{*form.plane, {}});
}

}  // namespace

void ask_for_undercut(const PanelContext& context, const std::optional<Vec3>& axis) {
  ReviewForm& form = context.state.review;
  form.shows_undercut = true;
  context.commands.emplace_back(FindUndercut{{axis, form.around_mm, form.radius_mm}});
}

void handle_review_input(const PanelContext& context) {
  const bool is_first = ImGui::IsItemActivated();
  const auto& dab = context.state.brush.under_pointer;
  if (!ImGui::IsItemActive() || !ImGui::IsMouseDown(0) || !dab) return;
  const Vec3 p_mm = dab->center_mm.cast<double>();
  const ReviewMode mode = context.state.review.mode;
  if (mode == ReviewMode::kSection) return cut(context, p_mm, is_first);
  if (!is_first) return;
  if (mode == ReviewMode::kDistance) click_distance(context, p_mm);
  if (mode == ReviewMode::kAngle) click_angle(context, p_mm);
  if (mode == ReviewMode::kUndercut) click_undercut(context, p_mm);
  if (mode == ReviewMode::kMargin) click_margin(context, p_mm);
}

}  // namespace flytri::ui
