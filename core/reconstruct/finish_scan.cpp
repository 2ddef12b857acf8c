#include "core/reconstruct/finish_scan.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "core/calibration/record/sensor_size.h"
#include "core/editing/serving_views.h"
#include "core/meshing/mesh_topology.h"
#include "core/reconstruct/correct_projectors.h"
#include "core/reconstruct/locked_surface.h"
#include "core/reconstruct/row_share.h"
#include "core/texture/level_frames.h"
#include "core/texture/observe.h"
#include "core/texture/vertex_colors.h"
#include "core/trajectory/motion_model.h"

namespace flytri::reconstruct {
namespace {

/// Share of the meshing time for judging distances.
constexpr double kJudgingShare = 0.2;
/// Share of the aligning time for finding out whether the shutter is a rolling one.
constexpr double kReadoutShare = 0.15;
/// Share of the texturing time for coloring the points, and the same share for the vertices.
constexpr double kColoringShare = 0.15;

/// One run: keeps the data passed from stage to stage.
class Finisher {
 public:
  Finisher(ScannedViews& scanned, const FinishOptions& options, const Workers& workers,
           const Progress& progress, StageClock& clock)
      : scanned_(scanned),
        options_(options),
        workers_(workers),
        progress_(progress),
        clock_(clock),
        edits_(scanned.edits),
        locked_(scanned.views, scanned.edits, scanned.held) {}

  Result<FinishedScan> run();

 private:
  Result<void> refine_views();
  Result<void> correct_rows(refinement::Refinement& refined, std::vector<AlignedView>& serving);
  Result<void> correct_views(refinement::Refinement& refined, std::vector<AlignedView>& serving);
  void take_poses(std::span<const AlignedView> refined);
  void place_texture_frames();
  Result<std::vector<SurfaceSample>> find_samples();
  Result<void> make_points();
  Result<void> make_surface();
  Result<void> judge_distances();
  [[nodiscard]] std::vector<texture::TextureFrame> usable_frames() const;
  void add_former_frames(std::vector<texture::TextureFrame>& frames) const;
  Result<void> apply_texture();
  void note_surface();

  ScannedViews& scanned_;
  const FinishOptions& options_;
  const Workers& workers_;
  const Progress& progress_;
  StageClock& clock_;
  const editing::EditFilter edits_;
  const LockedSurface locked_;
  std::vector<AlignedView> serving_;  ///< what the edits keep of the views of the result
  std::vector<editing::HeldSurface::PlacedFrame> textures_;  ///< that colored the surface
  FinishedScan result_;
};

Result<void> Finisher::refine_views() {
  const std::vector<AlignedView>& views = scanned_.views;
  progress_.begin_stage(kAligning);
  std::vector<AlignedView> serving = editing::serving_views(views, edits_, workers_);
  const bool checks_rows = scanned_.calibration != nullptr && options_.correct_rolling_shutter;
  Result<refinement::Refinement> refined =
      refinement::refine_jointly(serving, options_.refinement, workers_,
                                 progress_.part(checks_rows ? 1.0 - kReadoutShare : 1.0));
  take_poses(serving);
  if (!refined) return tl::unexpected(refined.error());
  if (!locked_.empty()) {
    const Isometry T_held_world = locked_.place(scanned_.views);
    for (AlignedView& view : scanned_.views)
      view.T_world_sensor = T_held_world * view.T_world_sensor;
  }
  for (std::size_t i = 0; i < serving.size(); ++i)
    serving[i].T_world_sensor = views[i].T_world_sensor;
  clock_.end_stage("joint refinement", views.size(), "views");
  if (checks_rows) {
    if (auto ok = correct_rows(*refined, serving); !ok) return tl::unexpected(ok.error());
  }
  if (auto ok = correct_views(*refined, serving); !ok) return tl::unexpected(ok.error());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (refined->contradicts(i, options_.refinement)) {
      result_.contradicting.push_back(views[i].view->frame);
    } else {
      result_.views.push_back(views[i]);
      result_.T_world_sensor.push_back(serving[i].T_world_sensor);
      serving_.push_back(serving[i]);
    }
  }
  return {};
}

/// Puts the points where they were at the time of their view if the shutter is a rolling one.
Result<void> Finisher::correct_rows(refinement::Refinement& refined,
                                    std::vector<AlignedView>& serving) {
  const trajectory::RowShare row_share = row_share_of(*scanned_.calibration);
  auto readout = refinement::estimate_readout(serving, row_share, options_.refinement, workers_,
                                              progress_.part(kReadoutShare));
  if (!readout) return tl::unexpected(readout.error());
  if (!readout->is_long()) return {};
  progress_.begin_stage(kAligning);
  std::vector<AlignedView> corrected = serving;
  auto fit = refinement::refine_with_readout(corrected, *readout, row_share, options_.refinement,
                                             workers_, progress_);
  if (!fit) return tl::unexpected(fit.error());
  serving = std::move(corrected);
  refined = *std::move(fit);
  result_.readout = *readout;
  clock_.end_stage("rolling shutter", serving.size(), "views");
  return {};
}

/// Puts the points where they are if a projector had moved.
Result<void> Finisher::correct_views(refinement::Refinement& refined,
                                     std::vector<AlignedView>& serving) {
  if (scanned_.calibration == nullptr || !options_.correct_projectors) return {};
  const auto shifted =
      calibration::find_shifted_spans(serving, scanned_.calibration->volume.size_mm);
  if (shifted.empty()) return {};
  progress_.begin_stage(kAligning);
  auto corrected = correct_projectors(serving, refined, shifted, *scanned_.calibration,
                                      options_.refinement, workers_, progress_);
  if (!corrected) return tl::unexpected(corrected.error());
  if (!*corrected) return {};
  serving = std::move((*corrected)->views);
  refined = std::move((*corrected)->refinement);
  result_.moved_projectors = std::move((*corrected)->moved);
  clock_.end_stage("moved projector", serving.size(), "views");
  return {};
}

/// A view of which nothing serves moves with the one before it.
void Finisher::take_poses(std::span<const AlignedView> refined) {
  Isometry T_new_world = Isometry::Identity();
  for (std::size_t i = 0; i < refined.size(); ++i) {
    Isometry& T_world_sensor = scanned_.views[i].T_world_sensor;
    if (refined[i].view->profiles.empty()) {
      T_world_sensor = T_new_world * T_world_sensor;
    } else {
      T_new_world = refined[i].T_world_sensor * T_world_sensor.inverse();
      T_world_sensor = refined[i].T_world_sensor;
    }
  }
}

void Finisher::place_texture_frames() {
  if (scanned_.texture_frames.empty()) return;
  std::vector<trajectory::TimedPose> path;
  for (const AlignedView& view : serving_) {
    path.push_back({view.view->time_s, view.T_world_sensor});
  }
  const trajectory::MotionModel motion(path, 0.5 * scanned_.calibration->volume.size_mm.norm(),
                                       options_.max_gap_s);
  for (const Frame& frame : scanned_.texture_frames) {
    const bool is_usable =
        texture::check_texture_image(frame.image, *scanned_.calibration).has_value();
    result_.T_world_texture.push_back(is_usable ? motion.interpolate(frame.time_s) : std::nullopt);
  }
}

/// The measured points that serve, with normals.
Result<std::vector<SurfaceSample>> Finisher::find_samples() {
  progress_.begin_stage(kNormals);
  const auto normals = normals::crossing_normals(serving_, options_.normals, workers_, progress_);
  if (!normals) return tl::unexpected(normals.error());
  std::vector<SurfaceSample> samples = normals::surface_samples(serving_, *normals, workers_);
  clock_.end_stage("normals", samples.size(), "points");
  return samples;
}

Result<void> Finisher::make_points() {
  const auto samples = find_samples();
  if (!samples) return tl::unexpected(samples.error());
  progress_.begin_stage(kSimplifying);
  Result<reduction::Reduction> reduction =
      reduction::reduce_samples(*samples, options_.reduction, workers_, progress_);
  if (!reduction) return tl::unexpected(reduction.error());
  result_.points = std::move(reduction->points);
  locked_.keep_points(result_.points);
  clock_.end_stage("reduction", samples->size(), "points");
  return {};
}

Result<void> Finisher::make_surface() {
  progress_.begin_stage(kMeshing);
  meshing::MeshOptions options = options_.meshing;
  if (!locked_.empty()) options.spacing_mm = locked_.spacing_mm();
  Result<meshing::SurfaceMesh> surface =
      meshing::mesh_surface(result_.points, options, workers_, progress_.part(1.0 - kJudgingShare));
  if (!surface) return tl::unexpected(surface.error());
  result_.surface = std::move(*surface);
  clock_.end_stage("meshing", result_.points.size(), "points");
  result_.model.mesh = result_.surface.mesh;
  return {};
}

Result<void> Finisher::judge_distances() {
  // A face has no teeth.
  const calibration::Calibration* calibration = scanned_.calibration;
  if (calibration != nullptr && !calibration::fits_mouth(calibration->volume.size_mm)) return {};
  Result<std::vector<JudgedSpan>> spans =
      judge_spans(result_.surface.mesh, options_.jaw, serving_, options_.refinement, workers_,
                  progress_.part(kJudgingShare));
  if (!spans) return tl::unexpected(spans.error());
  result_.spans = *std::move(spans);
  clock_.end_stage("uncertainty", result_.spans.size(), "distances");
  return {};
}

/// The texture frames that have a pose.
std::vector<texture::TextureFrame> Finisher::usable_frames() const {
  std::vector<texture::TextureFrame> frames;
  for (std::size_t i = 0; i < scanned_.texture_frames.size(); ++i) {
    if (!result_.T_world_texture[i]) continue;
    frames.push_back({scanned_.texture_frames[i].image, *result_.T_world_texture[i]});
    if (edits_.empty()) continue;
    frames.back().serves = [this, time_s = scanned_.texture_frames[i].time_s](
                               const Vec3f& position_mm, const Vec3f& normal) {
      return !locked_.holds(position_mm, normal) && edits_.keeps(position_mm, normal, time_s);
    };
  }
  return frames;
}

/// Frames that colored the last run do it again where it is locked, with their former poses.
void Finisher::add_former_frames(std::vector<texture::TextureFrame>& frames) const {
  for (const Frame& frame : scanned_.texture_frames) {
    const auto former = locked_.former_texture(frame.time_s);
    if (!former) continue;
    frames.push_back({frame.image, former->T_world_sensor, former->gain,
                      [this, time_s = frame.time_s](const Vec3f& position_mm, const Vec3f& normal) {
                        return locked_.holds(position_mm, normal) &&
                               edits_.keeps(position_mm, normal, time_s);
                      }});
  }
}

/// Colors points and mesh.
Result<void> Finisher::apply_texture() {
  std::vector<texture::TextureFrame> frames = usable_frames();
  if (frames.empty()) return {};
  const calibration::Calibration& calibration = *scanned_.calibration;
  progress_.begin_stage(kTexturing);
  if (auto leveled = texture::level_frames(frames, result_.surface.mesh.vertices, calibration,
                                           options_.atlas.coloring, workers_);
      !leveled) {
    return tl::unexpected(leveled.error());
  }
  for (std::size_t i = 0, used = 0; i < scanned_.texture_frames.size(); ++i) {
    if (!result_.T_world_texture[i]) continue;
    textures_.push_back(
        {scanned_.texture_frames[i].time_s, *result_.T_world_texture[i], frames[used++].gain});
  }
  add_former_frames(frames);
  const std::array<std::span<SurfacePoint>, 2> surfaces = {result_.points,
                                                           result_.surface.mesh.vertices};
  for (const std::span<SurfacePoint> points : surfaces) {
    const auto counts = texture::color_points(points, frames, calibration, options_.atlas.coloring,
                                              workers_, progress_.part(kColoringShare));
    if (!counts) return tl::unexpected(counts.error());
    locked_.keep_colors(points);
  }
  Result<texture::BakedAtlas> baked =
      texture::bake_atlas(result_.surface.mesh, frames, calibration, options_.atlas, workers_,
                          progress_.part(1.0 - 2.0 * kColoringShare));
  if (!baked) return tl::unexpected(baked.error());
  result_.model = std::move(baked->model);
  clock_.end_stage("texture", frames.size(), "frames");
  return {};
}

/// Notes what the next run needs to keep the surface.
void Finisher::note_surface() {
  auto held = std::make_shared<editing::HeldSurface>();
  held->spacing_mm = result_.surface.spacing_mm;
  for (const AlignedView& view : scanned_.views) {
    held->seen_until_s = std::max(held->seen_until_s, view.view->time_s);
    held->views.push_back({view.view->time_s, view.T_world_sensor});
  }
  for (const auto& edit : *scanned_.edits) held->edited_at_s.push_back(edit->made_at_s);
  held->textures = std::move(textures_);
  held->points = result_.points;
  held->vertices = result_.surface.mesh.vertices;
  result_.held = std::move(held);
}

Result<FinishedScan> Finisher::run() {
  if (auto ok = refine_views(); !ok) return tl::unexpected(ok.error());
  place_texture_frames();
  if (auto ok = make_points(); !ok) return tl::unexpected(ok.error());
  if (auto ok = make_surface(); !ok) return tl::unexpected(ok.error());
  if (auto ok = judge_distances(); !ok) return tl::unexpected(ok.error());
  if (auto ok = apply_texture(); !ok) return tl::unexpected(ok.error());
  note_surface();
  // The user may have canceled after the last check.
  if (progress_.cancelled()) return stopped();
  return std::move(result_);
}

}  // namespace

FinishedScan finished_scan_of(TexturedMesh model) {
  FinishedScan finished;
  finished.model = std::move(model);
  texture::color_vertices(finished.model);
  finished.surface.mesh = meshing::welded(finished.model.mesh);
  meshing::repair_manifold(finished.surface.mesh);
  finished.surface.boundaries = meshing::find_boundaries(finished.surface.mesh);
  return finished;
}

Result<FinishedScan> finish_scan(ScannedViews& scanned, const FinishOptions& options,
                                 const Workers& workers, const Progress& progress,
                                 StageClock& clock) {
  return Finisher(scanned, options, workers, progress, clock).run();
}

}  // namespace flytri::reconstruct
