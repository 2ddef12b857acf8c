#include "ui/state/review_look.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ui/state/jaws_look.h"

namespace flytri::ui {
namespace {

/// What the mode of the tool has collected; null: a mode without clicks.
std::vector<Vec3>* clicks_of(ReviewForm& form) {
  switch (form.mode) {
    case ReviewMode::kAngle:
      return &form.angle_mm;
    case ReviewMode::kMargin:
      return &form.margin_mm;
    case ReviewMode::kSection:
      return &form.section_mm;
    case ReviewMode::kDistance:
    case ReviewMode::kUndercut:
      break;
  }
  return nullptr;
}

}  // namespace

bool is_reviewing(const AppView& view, const WindowState& state) {
  return state.tool == Tool::kMeasure && view.scan != nullptr &&
         view.scan->phase == scan::ScanPhase::kFinished && view.scan->result != nullptr &&
         shown_jaws(view, state) == nullptr;
}

bool is_reviewing(const AppView& view, const WindowState& state, ReviewMode mode) {
  return is_reviewing(view, state) && state.review.mode == mode;
}

std::shared_ptr<const UndercutMap> shown_undercut(const AppView& view, const WindowState& state) {
  const bool is_shown =
      state.review.shows_undercut && is_reviewing(view, state, ReviewMode::kUndercut);
  const auto& map = view.review.undercut;
  if (!is_shown || map == nullptr) return nullptr;
  const bool is_of_model = map->depth_mm.size() == view.scan->result->model.mesh.vertices.size();
  return is_of_model ? map : nullptr;
}

SectionAxes section_axes(const review::Plane& plane, const JawAxes* jaw) {
  constexpr double kLeastInPlane = 0.3;
  const Vec3 normal = plane.normal.stableNormalized();
  const auto in_plane = [&](const Vec3& direction) -> Vec3 {
    return direction - direction.dot(normal) * normal;
  };
  Vec3 up = normal.unitOrthogonal();
  if (jaw != nullptr) {
    const Vec3 occlusal = in_plane(jaw->occlusal), buccal = in_plane(jaw->buccal);
    up = (occlusal.norm() > kLeastInPlane ? occlusal : buccal).stableNormalized();
  }
  return {up.cross(normal), up};
}

void follow_reviewed_model(const AppView& view, WindowState& state) {
  if (view.scan == nullptr || view.scan->result == nullptr) return;
  ReviewForm& form = state.review;
  const std::uint64_t number = form.model.of(view.scan->result);
  if (number == form.model_number) return;
  const ReviewMode mode = form.mode;
  const ResultNumber model = form.model;
  form = {};
  form.mode = mode;
  form.model = model;
  form.model_number = number;
  state.measured_from_mm.reset();
}

bool can_keep_margin(const AppView& view, const WindowState& state) {
  const auto& drawn = view.review.drawn;
  return is_reviewing(view, state, ReviewMode::kMargin) && drawn != nullptr &&
         drawn->clicks_mm == state.review.margin_mm && !view.file.is_read_only;
}

bool has_click(const WindowState& state) {
  ReviewForm form = state.review;
  const std::vector<Vec3>* clicks = clicks_of(form);
  return clicks != nullptr ? !clicks->empty() : state.measured_from_mm.has_value();
}

bool take_click_back(WindowState& state) {
  if (!has_click(state)) return false;
  if (std::vector<Vec3>* clicks = clicks_of(state.review); clicks != nullptr) {
    clicks->pop_back();
  } else {
    state.measured_from_mm.reset();
  }
  return true;
}

std::string measured_text(const review::Measured& measured, double factor, int decimals,
                          const std::string& unit) {
  if (!std::isfinite(measured.uncertainty))
    return fmt::format("{:.{}f} ± ? {}", factor * measured.value, decimals, unit);
  return fmt::format("{:.{}f} ± {:.{}f} {}", factor * measured.value, decimals,
                     factor * measured.uncertainty, decimals, unit);
}

std::string measured_mm_text(const review::Measured& measured) {
  return measured_text(measured, 1.0, 3, "mm");
}

std::string measured_angle_text(const review::Measured& angle_rad) {
  return measured_text(angle_rad, 180.0 / std::numbers::pi, 2, "°");
}

}  // namespace flytri::ui
