/// @file  What colors show, and from where the model is seen.
#include <GLFW/glfw3.h>

#include <algorithm>

#include "ui/actions/action_groups.h"
#include "ui/state/camera_moves.h"
#include "ui/state/jaws_look.h"
#include "ui/state/review_look.h"

namespace flytri::ui {
namespace {

constexpr double kZoomStep = 1.15;
constexpr double kBlendStep = 0.05;

template <ColorMode kMode>
ActionState color_state(const Situation& now) {
  if (const JawPair* jaws = shown_jaws(now.view, now.state); jaws != nullptr) {
    if (kMode == ColorMode::kCoverage || kMode == ColorMode::kUncertainty)
      return disabled(Text::kNotForBothJaws);
    if (now.state.jaws.shows_clearance) return enabled();
  }
  if (shown_undercut(now.view, now.state) != nullptr) return enabled();
  const bool is_on = now.state.color_mode == kMode;
  if (kMode == ColorMode::kTexture && is_on) {
    return {.is_on = true, .text = percent_text(now.state.texture_blend)};
  }
  return chosen(is_on);
}

template <ColorMode kMode>
void color_by(const ActionRunner& run) {
  // Another stage's colors say nothing about the clearance.
  if (shown_jaws(run.view, run.state) != nullptr) run.state.jaws.shows_clearance = false;
  run.state.review.shows_undercut = false;
  run.state.color_mode = kMode;
}

ActionState crossed_state(const Situation& now) {
  if (now.view.scan == nullptr || now.is_finished() || now.view.scan->crossed_count == 0)
    return disabled(Text::kNothingHasGone);
  return chosen(now.view.scan->shows_crossed);
}

void toggle_crossed(const ActionRunner& run) {
  run.send(ShowCrossed{!run.view.scan->shows_crossed});
}

ActionState blend_state(const Situation& now) {
  return only_if(now.state.color_mode == ColorMode::kTexture, Text::kOnlyWithTexture);
}

void change_blend(const ActionRunner& run, double step) {
  run.state.texture_blend = std::clamp(run.state.texture_blend + step, 0.0, 1.0);
}

ActionState side_state(const Situation& now) {
  if (now.view.stage == io::ScanStage::kFace) return disabled(Text::kOnlyForAJaw);
  return only_if(now.has_surface(), Text::kNothingScanned);
}

template <StandardView kSide>
void look_from(const ActionRunner& run) {
  if (const JawPair* jaws = shown_jaws(run.view, run.state); jaws != nullptr)
    return show_from(kSide, jaws->upper_axes, JawKind::kUpper, run.state.view);
  show_from(kSide, run.view, run.state.view);
}

/// Of a quadrant nothing shows whether it is the right or the left one.
ActionState arch_side_state(const Situation& now) {
  if (ActionState any = side_state(now); !any.is_enabled) return any;
  if (const JawPair* jaws = shown_jaws(now.view, now.state); jaws != nullptr)
    return only_if(jaws->upper_axes.is_arch, Text::kNeedsWholeArch);
  return only_if(now.view.scan->jaw && now.view.scan->jaw->is_arch, Text::kNeedsWholeArch);
}

ActionState jaws_state(const Situation& now) {
  const bool is_possible = shows_finished_bite(now.view) && now.view.occlusion.pair != nullptr;
  if (!is_possible) return disabled(Text::kNeedsOcclusion);
  return chosen(now.state.jaws.are_shown);
}

/// The bite scan has a frame of its own.
void toggle_jaws(const ActionRunner& run) {
  JawsLook& look = run.state.jaws;
  look.are_shown = !look.are_shown;
  put_tool_away(run.state);
  reset_camera(run.state.view);
  if (look.are_shown) look_from<StandardView::kBuccal>(run);
}

ActionState clearance_state(const Situation& now) {
  if (shown_jaws(now.view, now.state) == nullptr) return disabled(Text::kNeedsOcclusion);
  return chosen(now.state.jaws.shows_clearance);
}

void toggle_clearance(const ActionRunner& run) {
  run.state.jaws.shows_clearance = !run.state.jaws.shows_clearance;
}

ActionState plane_state(const Situation& now) {
  if (io::is_bite(now.view.stage)) return disabled(Text::kNotForTheBite);
  if (!io::is_jaw(now.view.stage)) return disabled(Text::kOnlyForAJaw);
  const bool has_model = now.is_finished() && now.view.scan->result != nullptr;
  if (!has_model) return disabled(Text::kAfterFinish);
  return chosen(now.state.tool == Tool::kPlane, Text::kActive);
}

ActionState automatic_plane_state(const Situation& now) {
  ActionState plane = plane_state(now);
  if (!plane.is_enabled) return plane;
  if (now.view.file.is_read_only) return disabled(Text::kCaseIsReadOnly);
  return only_if(now.view.has_set_plane, Text::kPlaneIsAutomatic);
}

void reset_plane(const ActionRunner& run) {
  run.state.plane_points_mm.clear();
  run.send(SetOcclusalPlane{});
}

ActionState show_all_state(const Situation& now) {
  return chosen(now.state.view.follows_scan, Text::kFollowsScan);
}

void zoom(const ActionRunner& run, double factor) {
  run.state.view.follows_scan = false;
  run.state.view.camera.zoom(factor);
}

constexpr std::array kLookingActions = {
    ActionRow{.action = Action::kShading,
              .id = "shading",
              .name = Text::kShape,
              .shortcut = {GLFW_KEY_1},
              .state = color_state<ColorMode::kShading>,
              .perform = color_by<ColorMode::kShading>},
    ActionRow{.action = Action::kTexture,
              .id = "texture",
              .name = Text::kTexture,
              .shortcut = {GLFW_KEY_2},
              .state = color_state<ColorMode::kTexture>,
              .perform = color_by<ColorMode::kTexture>},
    ActionRow{.action = Action::kCoverage,
              .id = "coverage",
              .name = Text::kCoverage,
              .shortcut = {GLFW_KEY_3},
              .state = color_state<ColorMode::kCoverage>,
              .perform = color_by<ColorMode::kCoverage>},
    ActionRow{.action = Action::kUncertainty,
              .id = "uncertainty",
              .name = Text::kUncertainty,
              .shortcut = {GLFW_KEY_4},
              .state = color_state<ColorMode::kUncertainty>,
              .perform = color_by<ColorMode::kUncertainty>},
    ActionRow{.action = Action::kShowCrossed,
              .id = "show_crossed",
              .name = Text::kHasGone,
              .shortcut = {GLFW_KEY_U},
              .state = crossed_state,
              .perform = toggle_crossed},
    ActionRow{.action = Action::kBlendLess,
              .id = "blend_less",
              .name = Text::kLessTexture,
              .shortcut = {GLFW_KEY_COMMA, 0, true},
              .state = blend_state,
              .perform = [](const ActionRunner& run) { change_blend(run, -kBlendStep); }},
    ActionRow{.action = Action::kBlendMore,
              .id = "blend_more",
              .name = Text::kMoreTexture,
              .shortcut = {GLFW_KEY_PERIOD, 0, true},
              .state = blend_state,
              .perform = [](const ActionRunner& run) { change_blend(run, kBlendStep); }},
    ActionRow{.action = Action::kOcclusal,
              .id = "occlusal",
              .name = Text::kOcclusalView,
              .shortcut = {GLFW_KEY_O},
              .state = side_state,
              .perform = look_from<StandardView::kOcclusal>},
    ActionRow{.action = Action::kBuccal,
              .id = "buccal",
              .name = Text::kBuccalView,
              .shortcut = {GLFW_KEY_B},
              .state = side_state,
              .perform = look_from<StandardView::kBuccal>},
    ActionRow{.action = Action::kLingual,
              .id = "lingual",
              .name = Text::kLingualView,
              .shortcut = {GLFW_KEY_L},
              .state = side_state,
              .perform = look_from<StandardView::kLingual>},
    ActionRow{.action = Action::kRightSide,
              .id = "right_side",
              .name = Text::kRightSide,
              .shortcut = {GLFW_KEY_R, GLFW_MOD_SHIFT},
              .state = arch_side_state,
              .perform = look_from<StandardView::kRight>},
    ActionRow{.action = Action::kLeftSide,
              .id = "left_side",
              .name = Text::kLeftSide,
              .shortcut = {GLFW_KEY_L, GLFW_MOD_SHIFT},
              .state = arch_side_state,
              .perform = look_from<StandardView::kLeft>},
    ActionRow{.action = Action::kShowAll,
              .id = "show_all",
              .name = Text::kShowAll,
              .shortcut = {GLFW_KEY_HOME},
              .state = show_all_state,
              .perform = [](const ActionRunner& run) { reset_camera(run.state.view); }},
    ActionRow{.action = Action::kJaws,
              .id = "jaws",
              .name = Text::kBothJaws,
              .shortcut = {GLFW_KEY_5},
              .state = jaws_state,
              .perform = toggle_jaws},
    ActionRow{.action = Action::kClearance,
              .id = "clearance",
              .name = Text::kClearance,
              .shortcut = {GLFW_KEY_6},
              .state = clearance_state,
              .perform = toggle_clearance},
    ActionRow{.action = Action::kOcclusalPlane,
              .id = "occlusal_plane",
              .name = Text::kOcclusalPlane,
              .shortcut = {GLFW_KEY_O, GLFW_MOD_SHIFT},
              .state = plane_state,
              .perform = [](const ActionRunner& run) { run.toggle(Tool::kPlane); }},
    ActionRow{.action = Action::kAutomaticPlane,
              .id = "automatic_plane",
              .name = Text::kAutomaticPlane,
              .shortcut = {GLFW_KEY_DELETE, GLFW_MOD_SHIFT},
              .state = automatic_plane_state,
              .perform = reset_plane,
              .is_listed = false},
    ActionRow{.action = Action::kZoomIn,
              .id = "zoom_in",
              .name = Text::kZoomIn,
              .shortcut = {GLFW_KEY_EQUAL, 0, true},
              .perform = [](const ActionRunner& run) { zoom(run, kZoomStep); }},
    ActionRow{.action = Action::kZoomOut,
              .id = "zoom_out",
              .name = Text::kZoomOut,
              .shortcut = {GLFW_KEY_MINUS, 0, true},
              .perform = [](const ActionRunner& run) { zoom(run, 1.0 / kZoomStep); }}};
static_assert(lists_all_of(ActionGroup::kLooking, kLookingActions));

}  // namespace

std::span<const ActionRow> looking_actions() { return kLookingActions; }

}  // namespace flytri::ui
