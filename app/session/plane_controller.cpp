#include "app/session/plane_controller.h"

#include "core/occlusion/patient_frame.h"

namespace flytri::session {

Result<ui::OcclusalPlane> plane_of(const TriangleMesh& jaw, JawKind kind,
                                   const std::optional<OcclusalPoints>& points) {
  const Result<Isometry> T_patient_world =
      points ? occlusion::T_patient_jaw(jaw, kind, *points) : occlusion::T_patient_jaw(jaw, kind);
  if (!T_patient_world) return tl::unexpected(T_patient_world.error());
  ui::OcclusalPlane plane;
  plane.T_world_patient = T_patient_world->inverse();
  for (const SurfacePoint& vertex : jaw.vertices)
    plane.box_mm.extend(Vec3(*T_patient_world * vertex.position_mm.cast<double>()));
  plane.is_arch = jaw_axes(jaw).is_arch;
  return plane;
}

PlaneController::Model PlaneController::shown_model() const {
  if (!reconstruct::jaw_of(stages_.stage())) return nullptr;
  return stages_.model_of(stages_.stage()).scan;
}

void PlaneController::find() {
  const Model model = shown_model();
  if (model == nullptr || is_running_ || model == known_model_) return;
  compute(stages_.plane_of(stages_.stage()), false);
}

void PlaneController::set(const std::optional<OcclusalPoints>& points) {
  if (shown_model() != nullptr) compute(points, true);
}

void PlaneController::compute(const std::optional<OcclusalPoints>& points, bool is_new) {
  is_running_ = true;
  const io::ScanStage stage = stages_.stage();
  background_.run([this, model = shown_model(), stage, points, is_new] {
    const TriangleMesh& mesh = model->surface.mesh;
    const JawKind kind = *reconstruct::jaw_of(stage);
    auto found = std::make_shared<Result<ui::OcclusalPlane>>(plane_of(mesh, kind, points));
    // A plane that was set before the scan went on may not fit any more: then the found one is
    // shown.
    const auto shown = *found || is_new
                           ? found
                           : std::make_shared<Result<ui::OcclusalPlane>>(plane_of(mesh, kind, {}));
    return [this, model, stage, points, is_new, found, shown] {
      is_running_ = false;
      if (stages_.model_of(stage).scan != model) return;
      if (!*found) {
        notices_.add(ui::Severity::kWarning,
                     notices_.texts().fill<ui::Text::kPlaneRefused>(found->error().message));
      } else if (is_new) {
        stages_.set_plane(stage, points);
        if (stages_.plane_of(stage) != points) return;
      }
      if (!*shown) return;
      known_model_ = model;
      known_ = **shown;
    };
  });
}

std::optional<ui::OcclusalPlane> PlaneController::state() const {
  const Model model = shown_model();
  if (model == nullptr || model != known_model_) return std::nullopt;
  return known_;
}

}  // namespace flytri::session
