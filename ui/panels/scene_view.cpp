#include "ui/panels/scene_view.h"

#include <algorithm>

#include "ui/state/camera_moves.h"
#include "ui/state/jaws_look.h"
#include "ui/state/review_look.h"
#include "ui/state/shown_plane.h"
#include "ui/state/way_back.h"

namespace flytri::ui {
namespace {

void add_reentry(const PanelContext& context, SceneContent& content) {
  const scan::ScanSnapshot& scan = *context.view.scan;
  content.is_dimmed = true;
  if (scan.chosen_reentry >= scan.reentry.size()) return;
  const scan::ReentryPlace& place = scan.reentry[scan.chosen_reentry];
  content.highlighted = {place.first, place.second};
  content.sensors.push_back({place.first.T_world_sensor, context.view.volume_mm, true});
  if (const auto way = way_back(scan)) {
    content.sensors.push_back({way->T_world_sensor, context.view.volume_mm, false});
    // Above the surface, where it is not hidden.
    const Vec3 above_mm(0.0, 0.0, -0.6 * context.view.volume_mm.z());
    content.way_back = SceneArrow{way->T_world_sensor * above_mm, way->T_world_place * above_mm};
  }
}

/// Where the sensor is, and in which direction the surface does not hold it.
void add_measuring_sensor(const PanelContext& context, SceneContent& content) {
  const scan::ScanSnapshot& scan = *context.view.scan;
  const Vec3& volume_mm = context.view.volume_mm;
  content.sensors.push_back({*scan.T_world_sensor, volume_mm, false});
  if (!scan.surface_hold.is_weak || !scan.surface_hold.direction) return;
  const tracking::WeakDirection& weak = *scan.surface_hold.direction;
  // Above the surface, where it is not hidden.
  const Vec3 above_mm = scan.T_world_sensor->linear() * Vec3(0.0, 0.0, -0.1 * volume_mm.z());
  const double reach_mm = 0.45 * volume_mm.head<2>().minCoeff();
  content.slip = SceneSlip{weak.center_mm + above_mm, weak.direction, weak.is_turn, reach_mm};
}

void add_preview(const PanelContext& context, SceneContent& content) {
  PreviewContent preview;
  preview.volume_mm = context.view.volume_mm;
  for (std::size_t i = 0; i < preview.views.size(); ++i) {
    const auto& frame = context.view.scan->latest[i];
    if (frame != nullptr) preview.views[i] = frame->view;
  }
  content.preview = preview;
}

void add_phase(const PanelContext& context, SceneContent& content) {
  const scan::ScanSnapshot& scan = *context.view.scan;
  const bool is_empty = surfel_count(scan.model) == 0;
  switch (scan.phase) {
    case scan::ScanPhase::kPreview:
      if (is_empty) add_preview(context, content);
      break;
    case scan::ScanPhase::kMeasurement:
      if (scan.T_world_sensor && context.view.is_scanning) add_measuring_sensor(context, content);
      break;
    case scan::ScanPhase::kContinuation:
      add_reentry(context, content);
      break;
    case scan::ScanPhase::kFinishing:
      content.is_dimmed = true;
      break;
    case scan::ScanPhase::kFinished:
      break;
  }
}

/// In a frame of their own: nothing of the bite scan is drawn over them.
SceneContent jaws_content(const PanelContext& context, const JawPair& jaws) {
  SceneContent content;
  content.mesh = &jaws.mesh;
  content.mesh_number = context.state.result_number.of(context.view.occlusion.pair);
  content.jaws = SceneJaws{jaws.first_lower, &jaws.clearance_mm};
  return content;
}

void add_surface(const PanelContext& context, SceneContent& content) {
  const scan::ScanSnapshot& scan = *context.view.scan;
  content.model = &scan.model;
  if (scan.phase == scan::ScanPhase::kFinished && scan.result != nullptr) {
    content.mesh = &scan.result->model;
    content.mesh_number = context.state.result_number.of(scan.result);
  }
}

/// Holes are drawn in the colors of coverage, or when one is selected.
void add_holes(const PanelContext& context, SceneContent& content) {
  const std::vector<meshing::BoundaryLoop>& holes = context.view.scan->holes;
  auto& selected = context.state.selected_hole;
  if (selected) selected = found_again(*selected, holes);
  if (selected) content.selected_hole = selected->index;
  const bool is_lost = context.phase() == scan::ScanPhase::kContinuation;
  if (is_lost) return;
  if (selected || context.state.color_mode == ColorMode::kCoverage) content.holes = &holes;
}

/// An unlocking stroke removes the locked dabs that it touches.
void free_locked(const std::vector<editing::BrushDab>& unlocking,
                 std::vector<editing::BrushDab>& locked) {
  std::erase_if(locked, [&](const editing::BrushDab& dab) {
    return std::any_of(unlocking.begin(), unlocking.end(), [&](const editing::BrushDab& by) {
      return (dab.center_mm - by.center_mm).norm() < by.radius_mm;
    });
  });
}

void add_locks(editing::EditKind kind, const std::vector<editing::BrushDab>& dabs,
               std::vector<editing::BrushDab>& locked) {
  if (kind == editing::EditKind::kUnlock) free_locked(dabs, locked);
  if (kind == editing::EditKind::kLock) locked.insert(locked.end(), dabs.begin(), dabs.end());
}

/// Tints what is locked, and what the stroke that is being painted will change.
void add_tints(const PanelContext& context, SceneContent& content) {
  if (const auto& edits = context.view.scan->edits; edits != nullptr) {
    for (const auto& edit : *edits) add_locks(edit->kind, edit->dabs, content.tints.locked);
  }
  const WindowState& state = context.state;
  if (!has_brush(state.tool)) return;
  const editing::EditKind kind = kind_of(state.tool);
  if (kind == editing::EditKind::kTrim) content.tints.to_trim = state.brush.stroke;
  add_locks(kind, state.brush.stroke, content.tints.locked);
}

void add_tools(const PanelContext& context, SceneContent& content) {
  const WindowState& state = context.state;
  const bool measures_otherwise = is_reviewing(context.view, state) &&
                                  !is_reviewing(context.view, state, ReviewMode::kDistance);
  if (!measures_otherwise) {
    for (const io::Measurement& measured : context.view.measurements)
      content.measurements.push_back({measured.from_mm, measured.to_mm, false});
  }
  if (!measures_otherwise && state.measured_from_mm && state.brush.under_pointer) {
    content.measurements.push_back(
        {*state.measured_from_mm, state.brush.under_pointer->center_mm.cast<double>(), true});
  }
  if (const auto plane = shown_plane(context.view, state))
    content.plane = ScenePlane{plane->T_world_patient, plane->box_mm};
  content.marks_mm = state.plane_points_mm;
  if (has_brush(state.tool) && state.brush.under_pointer) {
    content.brush = BrushCursor{*state.brush.under_pointer, kind_of(state.tool)};
  }
}

constexpr Color kOutdated = {0.55F, 0.55F, 0.55F, 1.0F};

std::vector<Vec3> places_of(const review::Polyline& line) {
  std::vector<Vec3> places_mm;
  places_mm.reserve(line.points.size());
  for (const review::MeasuredPoint& point : line.points) places_mm.push_back(point.position_mm);
  return places_mm;
}

void add_line(const review::Polyline& line, const Color& color, SceneContent& content) {
  content.lines.push_back({places_of(line), line.is_closed, color});
}

void add_angles(const PanelContext& context, SceneContent& content) {
  for (const review::ReviewedNumber& angle : context.view.review.angles_rad) {
    const auto& at = angle.points;
    content.measurements.push_back({at[1].position_mm, at[0].position_mm, false});
    content.measurements.push_back({at[1].position_mm, at[2].position_mm, false});
  }
}

void add_section(const PanelContext& context, SceneContent& content) {
  const auto& section = context.view.review.section;
  if (section == nullptr) return;
  for (const review::Polyline& line : section->outlines) add_line(line, kNeutral, content);
  for (const review::SectionPlace& place : section->places)
    content.marks_mm.push_back(place.point.position_mm);
}

void add_axis(const PanelContext& context, SceneContent& content) {
  const auto map = shown_undercut(context.view, context.state);
  if (map == nullptr) return;
  content.undercut = SceneUndercut{&map->depth_mm, context.state.undercut_number.of(map)};
  const double length_mm = 1.6 * map->radius_mm;
  content.axis = SceneArrow{map->middle_mm, map->middle_mm + length_mm * map->reviewed.axis};
}

/// What the tool for measuring shows in its mode; kept margin lines are always shown.
void add_review(const PanelContext& context, SceneContent& content) {
  const AppView& view = context.view;
  for (const KeptMargin& kept : view.review.margins)
    add_line(kept.margin->line, kept.is_outdated ? kOutdated : kGood, content);
  if (!is_reviewing(view, context.state)) return;
  const ReviewForm& form = context.state.review;
  if (form.mode == ReviewMode::kAngle) {
    add_angles(context, content);
    content.marks_mm = form.angle_mm;
  }
  if (form.mode == ReviewMode::kSection) add_section(context, content);
  if (form.mode == ReviewMode::kUndercut) add_axis(context, content);
  if (form.mode != ReviewMode::kMargin) return;
  content.marks_mm = form.margin_mm;
  if (view.review.drawn != nullptr && !form.margin_mm.empty())
    add_line(view.review.drawn->margin.line, kCaution, content);
}

SceneContent content_of(const PanelContext& context) {
  if (const JawPair* jaws = shown_jaws(context.view, context.state); jaws != nullptr)
    return jaws_content(context, *jaws);
  SceneContent content;
  if (context.view.scan != nullptr) {
    add_surface(context, content);
    add_phase(context, content);
    add_holes(context, content);
    add_tints(context, content);
  }
  add_tools(context, content);
  add_review(context, content);
  return content;
}

SceneOptions options_of(const PanelContext& context) {
  SceneOptions options;
  options.color_mode = shown_colors(context.view, context.state);
  options.texture_blend = context.state.texture_blend;
  options.max_sigma_mm = ui::max_sigma_mm(context.view.volume_mm);
  options.scale = static_cast<double>(context.theme.scale);
  // Surfels have no depth of undercut.
  if (options.color_mode == ColorMode::kUndercut) options.level_of_detail = false;
  if (const JawPair* jaws = shown_jaws(context.view, context.state); jaws != nullptr) {
    options.contact_mm = context.state.jaws.contact_mm;
    options.T_open_closed = opening(jaws->upper_axes, context.state.jaws.opening);
    // Surfels have no clearance, and do not know which jaw they are of.
    options.level_of_detail = false;
  }
  return options;
}

}  // namespace

void draw_scene(const PanelContext& context) {
  CameraState& camera = context.state.view;
  move_automatically(context.view, context.scene.model_box_mm(), camera);
  camera.camera.advance(context.state.frame_s);
  context.scene.draw(content_of(context), options_of(context), camera.camera, camera.picture,
                     context.view.now_s);
}

}  // namespace flytri::ui
