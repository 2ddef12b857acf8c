/// @file  What colors show, and from where the model is seen.
#include <GLFW/glfw3.h>

#include <algorithm>

#include "ui/actions/action_groups.h"
#include "ui/state/camera_moves.h"

namespace flytri::ui {
namespace {

constexpr double kZoomStep = 1.15;
constexpr double kBlendStep = 0.05;

template <ColorMode kMode>
ActionState color_state(const Situation& now) {
  const bool is_on = now.state.color_mode == kMode;
  return chosen(is_on, kMode == ColorMode::kTexture ? percent_text(now.state.texture_blend) : "on");
}

template <ColorMode kMode>
void color_by(const ActionRunner& run) {
  run.state.color_mode = kMode;
}

ActionState blend_state(const Situation& now) {
  return only_if(now.state.color_mode == ColorMode::kTexture, "only with texture");
}

void change_blend(const ActionRunner& run, double step) {
  run.state.texture_blend = std::clamp(run.state.texture_blend + step, 0.0, 1.0);
}

ActionState side_state(const Situation& now) {
  return only_if(now.has_surface(), "nothing scanned yet");
}

template <StandardView kSide>
void look_from(const ActionRunner& run) {
  show_from(kSide, run.view, run.state.view);
}

/// Of a quadrant nothing shows whether it is the right or the left one.
ActionState arch_side_state(const Situation& now) {
  if (!now.has_surface()) return disabled("nothing scanned yet");
  return only_if(now.view.scan->jaw && now.view.scan->jaw->is_arch, "needs a whole arch");
}

ActionState show_all_state(const Situation& now) {
  return chosen(now.state.view.follows_scan, "follows the scan");
}

void zoom(const ActionRunner& run, double factor) {
  run.state.view.follows_scan = false;
  run.state.view.camera.zoom(factor);
}

constexpr std::array kLookingActions = {
    ActionRow{.action = Action::kShading,
              .id = "shading",
              .name = "Shape",
              .shortcut = {GLFW_KEY_1, "1"},
              .state = color_state<ColorMode::kShading>,
              .perform = color_by<ColorMode::kShading>},
    ActionRow{.action = Action::kTexture,
              .id = "texture",
              .name = "Texture",
              .shortcut = {GLFW_KEY_2, "2"},
              .state = color_state<ColorMode::kTexture>,
              .perform = color_by<ColorMode::kTexture>},
    ActionRow{.action = Action::kCoverage,
              .id = "coverage",
              .name = "Coverage",
              .shortcut = {GLFW_KEY_3, "3"},
              .state = color_state<ColorMode::kCoverage>,
              .perform = color_by<ColorMode::kCoverage>},
    ActionRow{.action = Action::kUncertainty,
              .id = "uncertainty",
              .name = "Uncertainty",
              .shortcut = {GLFW_KEY_4, "4"},
              .state = color_state<ColorMode::kUncertainty>,
              .perform = color_by<ColorMode::kUncertainty>},
    ActionRow{.action = Action::kBlendLess,
              .id = "blend_less",
              .name = "Less texture",
              .shortcut = {GLFW_KEY_COMMA, ",", 0, true},
              .state = blend_state,
              .perform = [](const ActionRunner& run) { change_blend(run, -kBlendStep); }},
    ActionRow{.action = Action::kBlendMore,
              .id = "blend_more",
              .name = "More texture",
              .shortcut = {GLFW_KEY_PERIOD, ".", 0, true},
              .state = blend_state,
              .perform = [](const ActionRunner& run) { change_blend(run, kBlendStep); }},
    ActionRow{.action = Action::kOcclusal,
              .id = "occlusal",
              .name = "Occlusal view",
              .shortcut = {GLFW_KEY_O, "O"},
              .state = side_state,
              .perform = look_from<StandardView::kOcclusal>},
    ActionRow{.action = Action::kBuccal,
              .id = "buccal",
              .name = "Buccal view",
              .shortcut = {GLFW_KEY_B, "B"},
              .state = side_state,
              .perform = look_from<StandardView::kBuccal>},
    ActionRow{.action = Action::kLingual,
              .id = "lingual",
              .name = "Lingual view",
              .shortcut = {GLFW_KEY_L, "L"},
              .state = side_state,
              .perform = look_from<StandardView::kLingual>},
    ActionRow{.action = Action::kRightSide,
              .id = "right_side",
              .name = "Right side",
              .shortcut = {GLFW_KEY_R, "Shift R", GLFW_MOD_SHIFT},
              .state = arch_side_state,
              .perform = look_from<StandardView::kRight>},
    ActionRow{.action = Action::kLeftSide,
              .id = "left_side",
              .name = "Left side",
              .shortcut = {GLFW_KEY_L, "Shift L", GLFW_MOD_SHIFT},
              .state = arch_side_state,
              .perform = look_from<StandardView::kLeft>},
    ActionRow{.action = Action::kShowAll,
              .id = "show_all",
              .name = "Show all",
              .shortcut = {GLFW_KEY_HOME, "Home"},
              .state = show_all_state,
              .perform = [](const ActionRunner& run) { reset_camera(run.state.view); }},
    ActionRow{.action = Action::kZoomIn,
              .id = "zoom_in",
              .name = "Zoom in",
              .shortcut = {GLFW_KEY_EQUAL, "+", 0, true},
              .perform = [](const ActionRunner& run) { zoom(run, kZoomStep); }},
    ActionRow{.action = Action::kZoomOut,
              .id = "zoom_out",
              .name = "Zoom out",
              .shortcut = {GLFW_KEY_MINUS, "-", 0, true},
              .perform = [](const ActionRunner& run) { zoom(run, 1.0 / kZoomStep); }}};
static_assert(lists_all_of(ActionGroup::kLooking, kLookingActions));

}  // namespace

std::span<const ActionRow> looking_actions() { return kLookingActions; }

}  // namespace flytri::ui
