#include "ui/panels/scene_input.h"

#include <algorithm>
#include <cmath>

#include "ui/panels/review_input.h"
#include "ui/state/review_look.h"

namespace flytri::ui {
namespace {

constexpr double kWheelZoom = 1.12;
constexpr double kWheelBrush = 1.12;
/// A stroke adds a dab when the pointer has moved by this share of the brush's radius.
constexpr float kDabStep = 0.4F;

bool steers_by_pointer(const PanelContext& context) {
  const auto& hand = context.view.source.hand;
  return hand && !hand->follows_path && context.state.tool == Tool::kNone;
}

/// The pointer in the picture, from its upper left corner.
Vec2 pointer_px(const PanelContext& context) {
  const ImVec2 at = ImGui::GetIO().MousePos;
  return {static_cast<double>(at.x - context.layout.picture.x),
          static_cast<double>(at.y - context.layout.picture.y)};
}

/// Finds the surface under the pointer for the chosen tool.
void find_under_pointer(const PanelContext& context) {
  BrushState& brush = context.state.brush;
  brush.under_pointer.reset();
  if (context.state.tool == Tool::kNone || !ImGui::IsItemHovered()) return;
  const Vec2 at = pointer_px(context);
  const std::optional<Pick> pick = context.scene.pick(at.x(), at.y());
  if (!pick) return;
  const double radius_mm = brush.radius_share * context.view.volume_mm.x();
  brush.under_pointer = editing::BrushDab{
      pick->p_world_mm.cast<float>(), pick->normal.cast<float>(), static_cast<float>(radius_mm)};
}

void add_dab(BrushState& brush) {
  if (!brush.under_pointer) return;
  const editing::BrushDab& dab = *brush.under_pointer;
  const bool is_far =
      brush.stroke.empty() ||
      (dab.center_mm - brush.stroke.back().center_mm).norm() > kDabStep * dab.radius_mm;
  if (is_far) brush.stroke.push_back(dab);
}

/// A stroke becomes one edit when the button is released.
void paint(const PanelContext& context) {
  BrushState& brush = context.state.brush;
  const bool is_down = ImGui::IsItemActive() && ImGui::IsMouseDown(0);
  if (is_down) return add_dab(brush);
  if (brush.stroke.empty()) return;
  context.commands.emplace_back(EditSurface{kind_of(context.state.tool), brush.stroke});
  brush.stroke.clear();
}

void measure(const PanelContext& context) {
  if (!ImGui::IsItemActivated() || !ImGui::IsMouseDown(0)) return;
  const auto& dab = context.state.brush.under_pointer;
  if (!dab) return;
  auto& from = context.state.measured_from_mm;
  if (!from) {
    from = dab->center_mm.cast<double>();
    return;
  }
  context.commands.emplace_back(AddMeasurement{{0, *from, dab->center_mm.cast<double>(), {}}});
  from.reset();
}

/// The third click sets the occlusal plane.
void click_plane(const PanelContext& context) {
  if (!ImGui::IsItemActivated() || !ImGui::IsMouseDown(0)) return;
  const auto& dab = context.state.brush.under_pointer;
  if (!dab) return;
  std::vector<Vec3>& clicked = context.state.plane_points_mm;
  clicked.emplace_back(dab->center_mm.cast<double>());
  OcclusalPoints points;
  if (clicked.size() < points.size()) return;
  std::copy_n(clicked.begin(), points.size(), points.begin());
  context.commands.emplace_back(SetOcclusalPlane{points});
  clicked.clear();
}

void point_hand(const PanelContext& context) {
  if (!ImGui::IsItemActive() || !ImGui::IsMouseDown(0)) return;
  const Vec2 at = pointer_px(context);
  const auto ray = context.state.view.camera.ray(at.x(), at.y(), context.state.view.picture);
  context.commands.emplace_back(PointHand{ray.origin(), ray.direction()});
}

/// The surface under the pointer.
std::optional<Vec3> place_under_pointer(const PanelContext& context) {
  const Vec2 at = pointer_px(context);
  const std::optional<Pick> pick = context.scene.pick(at.x(), at.y());
  if (!pick) return std::nullopt;
  return pick->p_world_mm;
}

/// A double click brings a place to the middle of the picture.
void center(const PanelContext& context) {
  constexpr double kFlight_s = 0.4;
  if (!ImGui::IsItemHovered() || !ImGui::IsMouseDoubleClicked(0)) return;
  const auto place_mm = place_under_pointer(context);
  if (!place_mm) return;
  CameraState& view = context.state.view;
  view.follows_scan = false;
  CameraPose pose = view.camera.destination();
  pose.target_mm = *place_mm;
  view.camera.fly_to(pose, kFlight_s);
}

/// The right button turns the view; so does the left one, if no tool uses it.
void turn(const PanelContext& context, bool left_is_free) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActivated()) context.state.view.pivot_mm = place_under_pointer(context);
  if (!ImGui::IsItemActive() || (io.MouseDelta.x == 0.0F && io.MouseDelta.y == 0.0F)) return;
  CameraState& view = context.state.view;
  const bool turns = ImGui::IsMouseDown(1) || (left_is_free && ImGui::IsMouseDown(0));
  const bool pans = ImGui::IsMouseDown(2) || (turns && io.KeyShift);
  if (!turns && !pans) return;
  view.follows_scan = false;
  const auto dx = static_cast<double>(io.MouseDelta.x), dy = static_cast<double>(io.MouseDelta.y);
  if (pans) return view.camera.pan(dx, dy, view.picture);
  const Vec3 pivot_mm = view.pivot_mm.value_or(view.camera.pose().target_mm);
  view.camera.orbit(dx, dy, view.picture, pivot_mm);
}

void turn_wheel(const PanelContext& context) {
  const auto wheel = static_cast<double>(ImGui::GetIO().MouseWheel);
  if (wheel == 0.0 || !ImGui::IsItemHovered()) return;
  if (has_brush(context.state.tool)) {
    double& share = context.state.brush.radius_share;
    share = std::clamp(share * std::pow(kWheelBrush, wheel), 0.01, 0.5);
    return;
  }
  const Vec2 at = pointer_px(context);
  context.state.view.follows_scan = false;
  context.state.view.camera.zoom_at(std::pow(kWheelZoom, wheel), at.x(), at.y(),
                                    context.state.view.picture);
}

}  // namespace

void handle_scene_input(const PanelContext& context) {
  find_under_pointer(context);
  const Tool tool = context.state.tool;
  if (has_brush(tool)) paint(context);
  if (is_reviewing(context.view, context.state)) {
    handle_review_input(context);
  } else if (tool == Tool::kMeasure) {
    measure(context);
  }
  if (tool == Tool::kPlane) click_plane(context);
  const bool steers = steers_by_pointer(context);
  if (steers) point_hand(context);
  const bool left_is_free = tool == Tool::kNone && !steers;
  if (left_is_free) center(context);
  turn(context, left_is_free);
  turn_wheel(context);
}

}  // namespace flytri::ui
