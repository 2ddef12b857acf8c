/// @file  The length of each measured distance, beside its middle in the scene, the angles, and
/// names of axes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "ui/panels/panels.h"
#include "ui/scene/scene_content.h"
#include "ui/state/jaws_look.h"
#include "ui/state/review_look.h"
#include "ui/state/shown_plane.h"

namespace flytri::ui {
namespace {

/// Position of a world point in the window; none if it is behind the eye.
std::optional<ImVec2> place_in_window(const CameraState& view, const Rect& picture,
                                      const Vec3& p_world_mm) {
  const Vec3 p_eye = view.camera.T_world_eye().inverse() * p_world_mm;
  if (p_eye.z() >= 0.0) return std::nullopt;
  // Depth does not matter here: any near and far plane around the point will do.
  const Eigen::Matrix4d P =
      view.camera.projection(view.picture.aspect(), -0.5 * p_eye.z(), -2.0 * p_eye.z());
  const Eigen::Vector4d clip = P * p_eye.homogeneous();
  const auto x = static_cast<float>(0.5 + 0.5 * clip.x() / clip.w());
  const auto y = static_cast<float>(0.5 - 0.5 * clip.y() / clip.w());
  return ImVec2(picture.x + x * picture.width, picture.y + y * picture.height);
}

constexpr float kLabelHeight = 28.0F;

void draw_label(const PanelContext& context, const ImVec2& middle, const std::string& text) {
  const Theme& theme = context.theme;
  const float height = context.px(kLabelHeight);
  const float width = std::ceil(text_width(theme.fonts.strong, text)) + 2.0F * context.px(10.0F);
  const Rect box = {std::round(middle.x - width / 2.0F), std::round(middle.y - height / 2.0F),
                    width, height};
  draw_box(box, with_opacity(kBackground, 0.85F), height / 2.0F);
  draw_text(box, {theme.fonts.strong, kText, Align::kCenter}, text);
}

/// Which way the axes of the patient point.
void draw_plane_labels(const PanelContext& context) {
  const auto plane = shown_plane(context.view, context.state);
  if (!plane) return;
  const auto [left, front, up] = ScenePlane{plane->T_world_patient, plane->box_mm}.axis_ends_mm();
  // Of a quadrant nothing shows whether it is the right or the left one.
  std::vector<std::pair<Vec3, Text>> labels = {{up, Text::kAxisUp}};
  labels.emplace_back(front, plane->is_arch ? Text::kViewFront : Text::kViewBuccal);
  if (plane->is_arch) labels.emplace_back(left, Text::kViewLeft);
  const Rect& picture = context.layout.picture;
  // Below the banner.
  const float top =
      context.layout.frame.y + context.px(kBannerHeight + kGapM + kLabelHeight / 2.0F);
  for (const auto& [end_mm, text] : labels) {
    auto at = place_in_window(context.state.view, picture, end_mm);
    if (!at || !picture.contains(*at)) continue;
    at->y = std::max(at->y, top);
    draw_label(context, *at, context.text(text));
  }
}

}  // namespace

void draw_distance_labels(const PanelContext& context) {
  if (shown_jaws(context.view, context.state) != nullptr) return;
  draw_plane_labels(context);
  const Rect& picture = context.layout.picture;
  const auto label = [&](const Vec3& place_mm, const std::string& text) {
    const auto place = place_in_window(context.state.view, picture, place_mm);
    if (place && picture.contains(*place)) draw_label(context, *place, text);
  };
  const bool reviews = is_reviewing(context.view, context.state);
  if (reviews && context.state.review.mode == ReviewMode::kAngle) {
    for (const review::ReviewedNumber& angle : context.view.review.angles_rad)
      label(angle.points[1].position_mm, measured_angle_text(angle.measured));
  }
  if (reviews && context.state.review.mode != ReviewMode::kDistance) return;
  const std::vector<review::Measured>& known = context.view.review.distances_mm;
  for (std::size_t i = 0; i < context.view.measurements.size(); ++i) {
    const io::Measurement& measured = context.view.measurements[i];
    label(0.5 * (measured.from_mm + measured.to_mm),
          i < known.size() ? measured_mm_text(known[i])
                           : fmt::format("{:.2f} mm", (measured.to_mm - measured.from_mm).norm()));
  }
}

}  // namespace flytri::ui
