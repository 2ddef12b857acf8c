#include "core/pipeline/reconstruct.h"

#include <algorithm>
#include <array>
#include <utility>

namespace flytri {
namespace {

tl::unexpected<Error> stopped() {
  return fail(ErrorCode::kCancelled, "stopped; nothing was written");
}

/// One run: holds what the stages hand to each other.
class Run {
 public:
  /// @param source  what is reconstructed, for messages
  Run(std::string source, const ReconstructOptions& options, const Workers& workers,
      const Progress& progress)
      : source_(std::move(source)),
        options_(options),
        workers_(workers),
        progress_(progress),
        clock_(options.now_s) {}

  Result<Reconstruction> from_recording(const Recording& recording, const Calibration& calibration);
  Result<Reconstruction> from_views(std::vector<std::shared_ptr<const View>> views);

 private:
  Result<void> measure_frames(const Recording& recording, const Calibration& calibration);
  Result<void> measure_frame(const Recording& recording, const Calibration& calibration,
                             std::size_t i);
  void accept_frames(std::size_t count);
  Result<void> align();
  Result<void> register_views();
  Result<void> refine_views();
  Result<void> make_points();
  Result<void> make_surface();
  void reject(FrameIndex frame, std::string reason);
  void place_texture_frames(const Recording& recording, const Calibration& calibration);
  Result<void> apply_texture(const Recording& recording, const Calibration& calibration);
  Result<Reconstruction> finish();

  std::string source_;
  const ReconstructOptions& options_;
  const Workers& workers_;
  const Progress& progress_;
  StageClock clock_;
  std::vector<std::shared_ptr<const View>> views_;  ///< by frame; null: not measured
  std::vector<AlignedView> aligned_;                ///< what was registered, by time
  Reconstruction result_;
};

void Run::reject(FrameIndex frame, std::string reason) {
  FrameReport& report = result_.frames[frame.at()];
  report.fate = FrameFate::kRejected;
  report.reason = std::move(reason);
  report.T_world_sensor.reset();
}

/// Measures frame i, or says in its report why not. A frame of the wrong size is an error: the
/// calibration is that of another sensor.
Result<void> Run::measure_frame(const Recording& recording, const Calibration& calibration,
                                std::size_t i) {
  const FrameIndex index(i);
  if (recording.frames[i].kind == FrameKind::kTexture) return {};
  const Result<Frame> frame = load_frame(recording, index);
  if (!frame) {
    reject(index, frame.error().message);
    return {};
  }
  Result<MeasuredView> measured = measure_view(*frame, calibration, options_.measure);
  if (!measured && measured.error().code == ErrorCode::kInconsistent) {
    const auto path = recording.folder / recording.frames[i].file;
    return fail(ErrorCode::kInconsistent, "{}: {}", path.string(), measured.error().message);
  }
  if (!measured) {
    reject(index, measured.error().message);
  } else if (measured->outcome != MeasureOutcome::kMeasured) {
    reject(index, std::string(to_string(measured->outcome)));
  } else {
    measured->view.frame = index;
    measured->view.time_s = recording.frames[i].time_s;
    result_.frames[i].point_count = measured->view.point_count();
    views_[i] = std::make_shared<const View>(std::move(measured->view));
  }
  return {};
}

void Run::accept_frames(std::size_t count) {
  result_.frames.resize(count);
  views_.resize(count);
  for (std::size_t i = 0; i < count; ++i) result_.frames[i].frame = FrameIndex(i);
}

Result<void> Run::measure_frames(const Recording& recording, const Calibration& calibration) {
  const std::size_t count = recording.frames.size();
  accept_frames(count);
  progress_.begin_stage("Measuring lines", count);
  std::vector<Result<void>> outcomes(count);
  workers_.for_each(count, [&](std::size_t i) {
    if (!progress_.cancelled()) outcomes[i] = measure_frame(recording, calibration, i);
    progress_.advance();
  });
  for (const Result<void>& outcome : outcomes) {
    if (!outcome) return outcome;
  }
  clock_.end_stage("image to view", count, "frames");
  return {};
}

Result<void> Run::register_views() {
  Result<Registrar> registrar = Registrar::create(options_.registration);
  if (!registrar) return tl::unexpected(registrar.error());
  progress_.begin_stage("Registering views", views_.size());
  std::size_t view_count = 0;
  for (const auto& view : views_) {
    if (progress_.cancelled()) return stopped();
    progress_.advance();
    if (view == nullptr) continue;
    registrar->add(view);
    ++view_count;
  }
  for (const RegisteredView& registered : registrar->finish()) {
    const FrameIndex frame = registered.view->frame;
    if (registered.fate == ViewFate::kRejected) {
      reject(frame, std::string(to_string(registered.reason)));
      continue;
    }
    result_.frames[frame.at()].fate = registered.fate == ViewFate::kRegistered
                                          ? FrameFate::kRegistered
                                          : FrameFate::kInterpolated;
    aligned_.push_back({registered.view, registered.T_world_sensor});
  }
  clock_.end_stage("registration", view_count, "views");
  if (aligned_.size() >= 2) return {};
  return fail(ErrorCode::kInsufficient,
              "{}: of {} frames {} show lines inside the measurement volume, and no two of them "
              "could be registered; both patterns must light the same surface in turn",
              source_, result_.frames.size(), view_count);
}

Result<void> Run::refine_views() {
  const Result<Refinement> refined =
      refine_jointly(aligned_, options_.refinement, workers_, progress_);
  if (!refined) return tl::unexpected(refined.error());
  std::vector<AlignedView> kept;
  for (std::size_t i = 0; i < aligned_.size(); ++i) {
    if (refined->contradicts(i, options_.refinement)) {
      reject(aligned_[i].view->frame, "contradicts the other views");
    } else {
      kept.push_back(aligned_[i]);
    }
  }
  clock_.end_stage("joint refinement", aligned_.size(), "views");
  aligned_ = std::move(kept);
  return {};
}

void Run::place_texture_frames(const Recording& recording, const Calibration& calibration) {
  Trajectory trajectory(0.5 * calibration.volume.size_mm.norm());
  for (const AlignedView& view : aligned_) {
    trajectory.set(view.view->time_s, view.T_world_sensor);
  }
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    if (recording.frames[i].kind != FrameKind::kTexture) continue;
    FrameReport& report = result_.frames[i];
    report.T_world_sensor =
        trajectory.interpolate(recording.frames[i].time_s, options_.registration.max_gap_s);
    if (report.T_world_sensor) {
      report.fate = FrameFate::kTextured;
    } else {
      reject(FrameIndex(i), "no registered view before and after it");
    }
  }
}

Result<void> Run::make_points() {
  progress_.begin_stage("Thinning points", 2);
  const auto normals = crossing_normals(aligned_, options_.normals, workers_);
  if (!normals) return tl::unexpected(normals.error());
  const std::vector<SurfaceSample> samples = surface_samples(aligned_, *normals);
  clock_.end_stage("normals", samples.size(), "points");
  progress_.advance();
  if (progress_.cancelled()) return stopped();
  Result<Reduction> reduction = reduce_samples(samples, options_.reduction, workers_);
  if (!reduction) return tl::unexpected(reduction.error());
  result_.points = std::move(reduction->points);
  clock_.end_stage("reduction", samples.size(), "points");
  return {};
}

Result<void> Run::make_surface() {
  if (progress_.cancelled()) return stopped();
  progress_.begin_stage("Meshing", 1);
  Result<SurfaceMesh> surface = mesh_surface(result_.points, options_.meshing, workers_);
  if (!surface) return tl::unexpected(surface.error());
  result_.surface = std::move(*surface);
  clock_.end_stage("meshing", result_.points.size(), "points");
  result_.model.mesh = result_.surface.mesh;
  return {};
}

/// Colors points and mesh from the texture frames that have a pose.
Result<void> Run::apply_texture(const Recording& recording, const Calibration& calibration) {
  std::vector<TextureFrame> frames;
  for (const FrameReport& report : result_.frames) {
    if (report.fate != FrameFate::kTextured) continue;
    const Result<Frame> frame = load_frame(recording, report.frame);
    if (!frame) {
      reject(report.frame, frame.error().message);
    } else {
      frames.push_back({frame->image, *report.T_world_sensor});
    }
  }
  progress_.begin_stage("Texturing", 3);
  const std::array<std::span<SurfacePoint>, 2> surfaces = {result_.points,
                                                           result_.surface.mesh.vertices};
  for (const std::span<SurfacePoint> points : surfaces) {
    if (progress_.cancelled()) return stopped();
    const auto counts =
        color_points(points, frames, calibration, options_.atlas.coloring, workers_);
    if (!counts) return tl::unexpected(counts.error());
    progress_.advance();
  }
  if (frames.empty()) {
    result_.model.mesh = result_.surface.mesh;
  } else {
    Result<BakedAtlas> baked =
        bake_atlas(result_.surface.mesh, frames, calibration, options_.atlas, workers_);
    if (!baked) return tl::unexpected(baked.error());
    result_.model = std::move(baked->model);
  }
  clock_.end_stage("texture", frames.size(), "frames");
  return {};
}

/// Registration and joint refinement.
Result<void> Run::align() {
  if (auto done = register_views(); !done) return done;
  if (auto done = refine_views(); !done) return done;
  for (const AlignedView& view : aligned_) {
    result_.frames[view.view->frame.at()].T_world_sensor = view.T_world_sensor;
  }
  return {};
}

Result<Reconstruction> Run::finish() {
  if (progress_.cancelled()) return stopped();
  result_.stages = clock_.stages();
  return std::move(result_);
}

Result<Reconstruction> Run::from_recording(const Recording& recording,
                                           const Calibration& calibration) {
  if (auto done = measure_frames(recording, calibration); !done) {
    return tl::unexpected(done.error());
  }
  if (auto done = align(); !done) return tl::unexpected(done.error());
  place_texture_frames(recording, calibration);
  if (auto done = make_points(); !done) return tl::unexpected(done.error());
  if (auto done = make_surface(); !done) return tl::unexpected(done.error());
  if (auto done = apply_texture(recording, calibration); !done) {
    return tl::unexpected(done.error());
  }
  return finish();
}

Result<Reconstruction> Run::from_views(std::vector<std::shared_ptr<const View>> views) {
  accept_frames(views.size());
  views_ = std::move(views);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    result_.frames[i].point_count = views_[i]->point_count();
  }
  if (auto done = align(); !done) return tl::unexpected(done.error());
  if (auto done = make_points(); !done) return tl::unexpected(done.error());
  if (auto done = make_surface(); !done) return tl::unexpected(done.error());
  return finish();
}

}  // namespace

std::string_view to_string(FrameFate fate) {
  switch (fate) {
    case FrameFate::kRegistered:
      return "registered";
    case FrameFate::kInterpolated:
      return "interpolated";
    case FrameFate::kTextured:
      return "textured";
    case FrameFate::kRejected:
      return "rejected";
  }
  return "";
}

Result<Reconstruction> reconstruct(const Recording& recording, const Calibration& calibration,
                                   const ReconstructOptions& options, const Workers& workers,
                                   const Progress& progress) {
  return Run(recording.folder.string(), options, workers, progress)
      .from_recording(recording, calibration);
}

Result<Reconstruction> reconstruct_views(std::vector<std::shared_ptr<const View>> views,
                                         const ReconstructOptions& options, const Workers& workers,
                                         const Progress& progress) {
  return Run("the views", options, workers, progress).from_views(std::move(views));
}

}  // namespace flytri
