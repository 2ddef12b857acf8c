/// @file  What of the measurements on a finished model is shown.
#pragma once

#include <memory>
#include <string>

#include "ui/state/app_view.h"
#include "ui/state/window_state.h"

namespace flytri::ui {

/// Whether the tool for measuring is in hand on a finished model: then the side panel measures.
[[nodiscard]] bool is_reviewing(const AppView& view, const WindowState& state);
[[nodiscard]] bool is_reviewing(const AppView& view, const WindowState& state, ReviewMode mode);

/// The undercut whose colors the model has; null: none.
[[nodiscard]] std::shared_ptr<const UndercutMap> shown_undercut(const AppView& view,
                                                                const WindowState& state);

/// How the picture of a section lies in its plane.
struct SectionAxes {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY();  ///< unit
};
/// The chewing surfaces are up; in a section along them, the lips or the cheek are.
/// @param jaw  null: not known
[[nodiscard]] SectionAxes section_axes(const review::Plane& plane, const JawAxes* jaw);

/// Forgets what was clicked on another model. Call once a frame.
void follow_reviewed_model(const AppView& view, WindowState& state);

/// Whether the margin line of all clicks was found, so that it can be kept.
[[nodiscard]] bool can_keep_margin(const AppView& view, const WindowState& state);

/// Takes back the latest click of the current mode. @return  false: there is none
bool take_click_back(WindowState& state);
[[nodiscard]] bool has_click(const WindowState& state);

/// "1.234 ± 0.012 mm": the value and its standard uncertainty, "?" if it is not known.
/// @param factor  from the unit of the number to the one that is shown
[[nodiscard]] std::string measured_text(const review::Measured& measured, double factor,
                                        int decimals, const std::string& unit);
[[nodiscard]] std::string measured_mm_text(const review::Measured& measured);
[[nodiscard]] std::string measured_angle_text(const review::Measured& angle_rad);

}  // namespace flytri::ui
