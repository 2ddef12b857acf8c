#include "ui/state/camera_moves.h"

#include <algorithm>
#include <numbers>

#include "ui/scene/box_corners.h"
#include "ui/state/jaw_words.h"
#include "ui/state/way_back.h"

namespace flytri::ui {
namespace {

constexpr double kFlight_s = 0.7;
/// While following the scan: each frame of the flight redraws the whole picture.
constexpr double kShortFlight_s = 0.35;
/// The followed box is larger than the model by this share of the measurement volume, so that the
/// camera does not move all the time.
constexpr double kRoomToGrow = 1.2;
/// Shows some surroundings, so that the user recognizes the place.
constexpr double kReentryRoom = 1.5;
/// Shares of the width and height of the picture that no panel covers.
constexpr double kFreeWidth = 0.62, kFreeHeight = 0.88;
/// Share of the picture's height that a hole fills.
constexpr double kHoleShare = 0.35;

/// The direction of the first view: along z of the world, with y down.
Eigen::Quaterniond first_sight() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
}

Eigen::AlignedBox3d volume_box(const Vec3& volume_mm) {
  return Eigen::AlignedBox3d(Vec3(-volume_mm / 2.0), Vec3(volume_mm / 2.0));
}

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, const Vec3& volume_mm) {
  const Vec3 margin = kRoomToGrow * volume_mm;
  return Eigen::AlignedBox3d(Vec3(box.min() - margin / 2.0), Vec3(box.max() + margin / 2.0));
}

void fly_to_show(std::span<const Vec3> points_mm, const Eigen::Quaterniond& q_world_eye,
                 double flight_s, CameraState& state) {
  const PictureSize free = {std::max(static_cast<int>(state.picture.width_px * kFreeWidth), 1),
                            std::max(static_cast<int>(state.picture.height_px * kFreeHeight), 1)};
  CameraPose pose = state.camera.fitting(points_mm, q_world_eye, free);
  pose.height_mm /= kFreeHeight;
  state.camera.fly_to(pose, flight_s);
}

void follow(const AppView& view, const Eigen::AlignedBox3d& model_box_mm, CameraState& state) {
  if (!state.follows_scan) return;
  // Without a model, the measurement volume is shown once.
  if (!state.followed_box_mm.isEmpty() &&
      (model_box_mm.isEmpty() || state.followed_box_mm.contains(model_box_mm))) {
    return;
  }
  show_all(view, model_box_mm, state);
}

/// Each stage and each case has its own world frame.
bool is_another_scan(const AppView& view, bool has_model, const CameraState& state) {
  return view.stage != state.seen_stage || (state.has_seen_model && !has_model);
}

void visit_reentry(const AppView& view, CameraState& state) {
  const scan::ScanSnapshot& scan = *view.scan;
  if (scan.reentry.empty() || state.seen_reentry == scan.chosen_reentry) return;
  state.seen_reentry = scan.chosen_reentry;
  const std::size_t index = std::min(scan.chosen_reentry, scan.reentry.size() - 1);
  CameraPose pose = pose_through_sensor(scan.reentry[index].first.T_world_sensor, view.volume_mm);
  pose.height_mm *= kReentryRoom;
  state.camera.fly_to(pose, kFlight_s);
}

/// Shows the sensor and the place to resume at together, as soon as it is known where the sensor
/// is.
void show_way_back(const AppView& view, CameraState& state) {
  const auto way = way_back(*view.scan);
  if (way && !state.has_seen_way_back) {
    Eigen::AlignedBox3d box;
    const Eigen::AlignedBox3d volume = volume_box(view.volume_mm);
    for (const Isometry& T : {way->T_world_sensor, way->T_world_place})
      box.extend(volume.transformed(T));
    fly_to_show(corners_of(box), state.camera.destination().q_world_eye, kFlight_s, state);
  }
  state.has_seen_way_back = way.has_value();
}

}  // namespace

void show_all(const AppView& view, const Eigen::AlignedBox3d& model_box_mm, CameraState& state) {
  const bool is_first = state.followed_box_mm.isEmpty();
  state.follows_scan = true;
  state.followed_box_mm =
      model_box_mm.isEmpty() ? volume_box(view.volume_mm) : grown(model_box_mm, view.volume_mm);
  // Room to grow only while scanning.
  const bool is_tight = !view.is_scanning && !model_box_mm.isEmpty();
  // A running flight keeps its final direction.
  fly_to_show(corners_of(is_tight ? model_box_mm : state.followed_box_mm),
              is_first ? first_sight() : state.camera.destination().q_world_eye,
              view.is_scanning ? kShortFlight_s : kFlight_s, state);
}

void reset_camera(CameraState& state) {
  state.follows_scan = true;
  state.followed_box_mm.setEmpty();
}

void show_from(StandardView side, const JawAxes& axes, JawKind jaw, CameraState& state) {
  if (axes.box_mm.isEmpty()) return;
  state.follows_scan = false;
  fly_to_show(axes.corners_mm(), orientation(axes, jaw, side), kFlight_s, state);
}

void show_from(StandardView side, const AppView& view, CameraState& state) {
  const scan::ScanSnapshot& scan = *view.scan;
  const JawAxes axes =
      scan.result != nullptr ? jaw_axes(scan.result->surface.mesh) : jaw_axes(scan.model);
  show_from(side, axes, jaw_of(view.stage), state);
}

void show_hole(const AppView& view, std::size_t index, WindowState& state) {
  const meshing::BoundaryLoop& hole = view.scan->holes[index];
  state.selected_hole = {index, hole.center_mm, hole.width_mm};
  state.view.follows_scan = false;
  const Vec3 up = state.view.camera.pose().q_world_eye * Vec3::UnitY();
  const double height_mm = std::max(hole.width_mm / kHoleShare, view.volume_mm.y());
  state.view.camera.fly_to(
      pose_facing(hole.center_mm.cast<double>(), hole.normal.cast<double>(), up, height_mm),
      kFlight_s);
}

void show_next_hole(const AppView& view, WindowState& state) {
  const std::vector<meshing::BoundaryLoop>& holes = view.scan->holes;
  if (holes.empty()) {
    state.selected_hole.reset();
    return;
  }
  const std::size_t next = state.selected_hole ? state.selected_hole->index + 1 : 0;
  show_hole(view, next % holes.size(), state);
}

void move_automatically(const AppView& view, const Eigen::AlignedBox3d& model_box_mm,
                        CameraState& state) {
  if (view.scan == nullptr) return;
  const bool has_model = !model_box_mm.isEmpty();
  if (is_another_scan(view, has_model, state)) reset_camera(state);
  state.seen_stage = view.stage;
  state.has_seen_model = has_model;
  const scan::ScanPhase phase = view.scan->phase;
  const bool was_lost = state.seen_phase == scan::ScanPhase::kContinuation;
  if (phase == scan::ScanPhase::kContinuation) {
    if (!was_lost) {
      state.seen_reentry.reset();
      state.has_seen_way_back = false;
    }
    visit_reentry(view, state);
    show_way_back(view, state);
  } else if (was_lost) {
    show_all(view, model_box_mm, state);
  } else {
    follow(view, model_box_mm, state);
  }
  state.seen_phase = phase;
}

}  // namespace flytri::ui
