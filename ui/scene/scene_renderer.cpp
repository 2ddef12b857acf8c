#include "ui/scene/scene_renderer.h"

#include <algorithm>
#include <array>

#include "ui/scene/coloring.h"
#include "ui/scene/composer.h"
#include "ui/scene/depth_pick.h"
#include "ui/scene/line_painter.h"
#include "ui/scene/mesh_picture.h"
#include "ui/scene/model_picture.h"

namespace flytri::ui {

struct SceneRenderer::State {
  State(SplatPainter splats, MeshPicture mesh_picture, Composer scene_composer)
      : model(std::move(splats)),
        mesh(std::move(mesh_picture)),
        composer(std::move(scene_composer)) {}

  ModelPicture model;
  MeshPicture mesh;
  Composer composer;
  SplatStore store;
  Eye eye;
  Eigen::AlignedBox3d model_box_mm;
  const PictureTarget* shown = nullptr;  ///< of the model or the mesh
  bool pulses = false;
  PixelBox changed_px;    ///< of the shown model or mesh
  PixelBox repainted_px;  ///< of the picture with all that lies over it
  SceneStatistics statistics;

  [[nodiscard]] Backdrop backdrop(const SceneContent& content, const SceneOptions& options) const {
    const double radius_mm = content.mesh != nullptr
                                 ? mesh.splat_radius_mm()
                                 : store.radius_mm() * radius_scale(model.detail_share());
    return {content.is_dimmed, static_cast<float>(radius_mm), options.background_top,
            options.background_bottom};
  }
  void update_model(const SceneContent& content, const SceneOptions& options,
                    const OrbitCamera& camera, const PictureSize& size, double now_s);
  void update_mesh(const SceneContent& content, const SceneOptions& options,
                   const OrbitCamera& camera, const PictureSize& size, double now_s);
};

namespace {

const SurfelModel& model_of(const SceneContent& content) {
  static const SurfelModel kNothing;
  return content.model != nullptr ? *content.model : kNothing;
}

Eigen::AlignedBox3d merged(Eigen::AlignedBox3d a, const Eigen::AlignedBox3d& b) {
  return a.extend(b);
}

}  // namespace

Result<SceneRenderer> SceneRenderer::create() {
  Result<SplatPainter> splats = SplatPainter::create();
  if (!splats) return tl::unexpected(splats.error());
  Result<MeshPainter> mesh = MeshPainter::create();
  if (!mesh) return tl::unexpected(mesh.error());
  // One for the model, one for the mesh in motion.
  Result<SplatPainter> more_splats = SplatPainter::create();
  if (!more_splats) return tl::unexpected(more_splats.error());
  Result<Composer> composer = Composer::create();
  if (!composer) return tl::unexpected(composer.error());
  return SceneRenderer(std::make_unique<State>(
      std::move(*splats), MeshPicture(std::move(*mesh), std::move(*more_splats)),
      std::move(*composer)));
}

SceneRenderer::SceneRenderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;
SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::State::update_model(const SceneContent& content, const SceneOptions& options,
                                        const OrbitCamera& camera, const PictureSize& size,
                                        double now_s) {
  const StoreChanges changes = store.update(model_of(content), content.tints);
  model_box_mm = store.box_mm();
  eye = make_eye(camera, size, merged(overlay_box_mm(content), model_box_mm));
  const ModelPicture::Done done = model.update(store, changes, eye, options, now_s);
  shown = &model.shown();
  changed_px = done.changed_px;
  statistics = {store.surfel_count(), done.drawn,    model.detail_share(),
                model.latest_ms(),    done.was_full, changes.uploaded_bytes};
}

void SceneRenderer::State::update_mesh(const SceneContent& content, const SceneOptions& options,
                                       const OrbitCamera& camera, const PictureSize& size,
                                       double now_s) {
  mesh.take(content, model_of(content));
  model_box_mm = mesh.box_mm();
  const Eigen::AlignedBox3d opened_mm =
      content.jaws ? model_box_mm.transformed(options.T_open_closed) : model_box_mm;
  eye = make_eye(camera, size, merged(overlay_box_mm(content), merged(model_box_mm, opened_mm)));
  changed_px = mesh.update(eye, options, now_s);
  shown = &mesh.shown();
  statistics = {};
  statistics.was_full = !changed_px.isEmpty();
  statistics.frame_ms = mesh.latest_ms();
}

void SceneRenderer::draw(const SceneContent& content, const SceneOptions& options,
                         const OrbitCamera& camera, const PictureSize& size, double now_s) {
  State& state = *state_;
  const PictureTarget* before = state.shown;
  if (content.mesh != nullptr) {
    state.update_mesh(content, options, camera, size, now_s);
  } else {
    state.update_model(content, options, camera, size, now_s);
  }
  state.pulses = std::any_of(content.sensors.begin(), content.sensors.end(),
                             [](const SceneSensor& sensor) { return sensor.pulses; });
  if (before != state.shown) state.changed_px = whole_picture(size);
  state.repainted_px = state.composer.compose(*state.shown, state.changed_px,
                                              overlay_lines(content, options, state.eye, now_s),
                                              state.eye, state.backdrop(content, options));
  Framebuffer::bind_window();
}

const Framebuffer& SceneRenderer::picture() const { return state_->composer.picture(); }

const PixelBox& SceneRenderer::repainted_px() const { return state_->repainted_px; }

bool SceneRenderer::wants_redraw() const {
  const bool shows_model = state_->shown == &state_->model.shown();
  return state_->pulses || (shows_model ? state_->model.is_coarse() : state_->mesh.is_coarse());
}

std::optional<Pick> SceneRenderer::pick(double x_px, double y_px) {
  if (state_->shown == nullptr) return std::nullopt;
  return pick_from_depth(*state_->shown, state_->eye, x_px, y_px);
}

const SceneStatistics& SceneRenderer::statistics() const { return state_->statistics; }

const Eigen::AlignedBox3d& SceneRenderer::model_box_mm() const { return state_->model_box_mm; }

}  // namespace flytri::ui
