#include "core/reconstruct/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/reconstruct/recover_views.h"
#include "core/texture/observe.h"

namespace flytri::reconstruct {
namespace {

/// Share of the time in which lost views are tried again, for those that a rolling shutter has
/// distorted.
constexpr double kRecoveringShare = 0.3;

io::FrameSizes sizes_of(const calibration::Calibration& calibration) {
  return {calibration.measurement_size, calibration.texture_size};
}

/// One run: keeps the data passed from stage to stage.
class Run {
 public:
  /// @param source  name of the input, for messages
  Run(std::string source, const ReconstructOptions& options, const Workers& workers,
      const Progress& progress)
      : source_(std::move(source)),
        options_(options),
        workers_(workers),
        progress_(progress),
        clock_(options.now_s) {}

  Result<Reconstruction> from_recording(const io::Recording& recording,
                                        const calibration::Calibration& calibration);
  Result<Reconstruction> from_stage(const io::StoredStage& stage,
                                    const calibration::Calibration& calibration);
  Result<Reconstruction> from_views(std::vector<std::shared_ptr<const View>> views);

 private:
  /// Reads all frames; registers the views of some while others are measured.
  Result<void> read_frames(const io::Recording& recording,
                           const calibration::Calibration& calibration,
                           tracking::Registrar& registrar);
  Result<void> read_frame(const io::Recording& recording,
                          const calibration::Calibration& calibration, std::size_t i);
  Result<void> measure_frame(const io::Recording& recording,
                             const calibration::Calibration& calibration, std::size_t i,
                             const Frame& frame);
  void accept_frames(std::size_t count);
  /// Registers views_[begin] to views_[end - 1].
  void register_views(tracking::Registrar& registrar, std::size_t begin, std::size_t end) const;
  Result<void> register_all_views(const calibration::Calibration* calibration);
  /// Takes the registered views, and registers lost ones again.
  /// @param calibration  of the sensor; null: not known
  Result<void> settle_views(tracking::Registrar& registrar,
                            const calibration::Calibration* calibration);
  [[nodiscard]] Error nothing_registered() const;
  void accept_stage(const io::StoredStage& stage);
  FrameReport& report_of(FrameIndex frame);
  void reject(FrameIndex frame, std::string reason);
  [[nodiscard]] std::string first_rejection() const;
  Result<Reconstruction> finish(ScannedViews scanned);

  std::string source_;
  const ReconstructOptions& options_;
  const Workers& workers_;
  const Progress& progress_;
  StageClock clock_;
  std::vector<std::shared_ptr<const View>> views_;  ///< by frame; null: not measured
  std::vector<Frame> texture_frames_;               ///< by rising time
  std::vector<AlignedView> aligned_;                ///< registered views by time
  Reconstruction result_;
};

FrameReport& Run::report_of(FrameIndex frame) {
  std::vector<FrameReport>& frames = result_.frames;
  return *std::lower_bound(
      frames.begin(), frames.end(), frame,
      [](const FrameReport& report, FrameIndex wanted) { return report.frame < wanted; });
}

void Run::reject(FrameIndex frame, std::string reason) {
  FrameReport& report = report_of(frame);
  report.fate = FrameFate::kRejected;
  report.reason = std::move(reason);
  report.T_world_sensor.reset();
}

/// Reads frame i. If that fails, its report says why. A measurement frame of another size is an
/// error: it is damaged, or the calibration is of another sensor.
Result<void> Run::read_frame(const io::Recording& recording,
                             const calibration::Calibration& calibration, std::size_t i) {
  const FrameIndex index(i);
  const bool is_texture = recording.frames[i].kind == FrameKind::kTexture;
  Result<Frame> frame = io::load_frame(recording, index, sizes_of(calibration));
  if (!frame && !is_texture && frame.error().code == ErrorCode::kInconsistent)
    return tl::unexpected(frame.error());
  if (!frame) {
    reject(index, frame.error().message);
    return {};
  }
  if (!is_texture) return measure_frame(recording, calibration, i, *frame);
  texture_frames_[i] = *std::move(frame);
  return {};
}

Result<void> Run::measure_frame(const io::Recording& recording,
                                const calibration::Calibration& calibration, std::size_t i,
                                const Frame& frame) {
  const FrameIndex index(i);
  Result<measurement::MeasuredView> measured =
      measurement::measure_view(frame, calibration, options_.measure);
  if (!measured && measured.error().code == ErrorCode::kInconsistent) {
    const auto path = recording.folder / recording.frames[i].file;
    return fail(ErrorCode::kInconsistent, "{}: {}", path.string(), measured.error().message);
  }
  if (!measured) {
    reject(index, measured.error().message);
  } else if (measured->outcome != measurement::MeasureOutcome::kMeasured) {
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

Result<void> Run::read_frames(const io::Recording& recording,
                              const calibration::Calibration& calibration,
                              tracking::Registrar& registrar) {
  constexpr std::size_t kBlock = 64;
  const std::size_t count = recording.frames.size();
  accept_frames(count);
  texture_frames_.resize(count);
  progress_.begin_stage("Measuring and registering lines", count);
  std::vector<Result<void>> outcomes(count);
  for (std::size_t begin = 0; begin < count + kBlock; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - std::min(begin, count));
    // Views can only be registered in order: those of the block before meanwhile.
    workers_.for_each(size + 1, [&](std::size_t i) {
      if (progress_.cancelled()) return;
      if (i == 0) return register_views(registrar, std::max(begin, kBlock) - kBlock, begin);
      outcomes[begin + i - 1] = read_frame(recording, calibration, begin + i - 1);
      progress_.advance();
    });
    if (progress_.cancelled()) return stopped();
  }
  const bool is_of_this_sensor =
      std::any_of(views_.begin(), views_.end(), [](const auto& view) { return view != nullptr; });
  for (std::size_t i = 0; i < count; ++i) {
    if (outcomes[i]) continue;
    if (!is_of_this_sensor) return outcomes[i];
    reject(FrameIndex(i), outcomes[i].error().message);
  }
  std::erase_if(texture_frames_, [](const Frame& frame) { return frame.image.empty(); });
  clock_.end_stage("image to registered view", count, "frames");
  return {};
}

void Run::register_views(tracking::Registrar& registrar, std::size_t begin, std::size_t end) const {
  for (std::size_t i = begin; i < std::min(end, views_.size()); ++i) {
    if (progress_.cancelled()) return;
    if (views_[i] != nullptr) registrar.add(views_[i]);
  }
}

Result<void> Run::register_all_views(const calibration::Calibration* calibration) {
  Result<tracking::Registrar> registrar = tracking::Registrar::create(options_.registration);
  if (!registrar) return tl::unexpected(registrar.error());
  progress_.begin_stage("Registering views", views_.size());
  for (std::size_t i = 0; i < views_.size(); ++i) {
    register_views(*registrar, i, i + 1);
    progress_.advance();
  }
  if (progress_.cancelled()) return stopped();
  return settle_views(*registrar, calibration);
}

Result<void> Run::settle_views(tracking::Registrar& registrar,
                               const calibration::Calibration* calibration) {
  progress_.begin_stage(kRecovering);
  const bool recovers = calibration != nullptr && options_.finish.correct_rolling_shutter;
  std::vector<tracking::RegisteredView> settled =
      registrar.finish(tracking::Registrar::World::kFirstView,
                       progress_.part(recovers ? 1.0 - kRecoveringShare : 1.0));
  if (progress_.cancelled()) return stopped();
  if (recovers) {
    auto recovered =
        recover_views(registrar, std::move(settled), *calibration, {options_.finish.refinement},
                      workers_, progress_.part(kRecoveringShare));
    if (!recovered) return tl::unexpected(recovered.error());
    settled = *std::move(recovered);
  }
  for (const tracking::RegisteredView& registered : settled) {
    const FrameIndex frame = registered.view->frame;
    if (registered.fate == tracking::ViewFate::kRejected) {
      reject(frame, std::string(to_string(registered.reason)));
      continue;
    }
    report_of(frame).fate = registered.fate == tracking::ViewFate::kRegistered
                                ? FrameFate::kRegistered
                                : FrameFate::kInterpolated;
    aligned_.push_back({registered.view, registered.T_world_sensor});
  }
  clock_.end_stage("registration", settled.size(), "views");
  if (aligned_.size() >= 2) return {};
  return tl::unexpected(nothing_registered());
}

/// Says which pattern is missing, as that is often the cause.
Error Run::nothing_registered() const {
  const auto count = [&](Pattern pattern) {
    return std::count_if(views_.begin(), views_.end(), [&](const auto& view) {
      return view != nullptr && view->pattern == pattern;
    });
  };
  const auto vertical = count(Pattern::kVertical), horizontal = count(Pattern::kHorizontal);
  std::string cause =
      "no two of them could be registered; light the same surface with both "
      "patterns in turn, and move the sensor slowly";
  if (vertical == 0 && horizontal == 0) {
    cause = "check the distance to the surface, the lights and the calibration";
  } else if (vertical == 0 || horizontal == 0) {
    cause = fmt::format("the {} pattern is missing; check its light, and \"kind\" of the frames",
                        to_string(vertical == 0 ? Pattern::kVertical : Pattern::kHorizontal));
  }
  return {
      ErrorCode::kInsufficient,
      fmt::format("{}: of {} frames {} show vertical and {} show horizontal lines in the "
                  "measurement volume: {}{}",
                  source_, result_.frames.size(), vertical, horizontal, cause, first_rejection())};
}

/// The end of a message; empty if no frame was rejected.
std::string Run::first_rejection() const {
  const auto first = std::find_if(result_.frames.begin(), result_.frames.end(),
                                  [](const FrameReport& report) { return !report.reason.empty(); });
  if (first == result_.frames.end()) return {};
  return fmt::format("; frame {} was rejected: {}", first->frame.value, first->reason);
}

/// Finishes the scan and completes the frame reports.
Result<Reconstruction> Run::finish(ScannedViews scanned) {
  Result<FinishedScan> finished =
      finish_scan(scanned, options_.finish, workers_, progress_, clock_);
  if (!finished) return tl::unexpected(finished.error());
  for (std::size_t i = 0; i < finished->views.size(); ++i) {
    report_of(finished->views[i].view->frame).T_world_sensor = finished->T_world_sensor[i];
  }
  for (const FrameIndex frame : finished->contradicting)
    reject(frame, "contradicts the other views");
  for (std::size_t i = 0; i < scanned.texture_frames.size(); ++i) {
    const FrameIndex frame = scanned.texture_frames[i].index;
    const auto fits =
        texture::check_texture_image(scanned.texture_frames[i].image, *scanned.calibration);
    if (!fits) {
      reject(frame, fits.error().message);
    } else if (!finished->T_world_texture[i]) {
      reject(frame, "no registered view before and after it");
    } else {
      report_of(frame).fate = FrameFate::kTextured;
      report_of(frame).T_world_sensor = finished->T_world_texture[i];
    }
  }
  result_.points = std::move(finished->points);
  result_.surface = std::move(finished->surface);
  result_.model = std::move(finished->model);
  result_.spans = std::move(finished->spans);
  if (scanned.calibration != nullptr)
    result_.pattern_shift =
        calibration::find_pattern_shift(finished->views, scanned.calibration->volume.size_mm);
  result_.moved_projectors = std::move(finished->moved_projectors);
  result_.readout = finished->readout;
  result_.held = std::move(finished->held);
  result_.stages = clock_.stages();
  return std::move(result_);
}

Result<Reconstruction> Run::from_recording(const io::Recording& recording,
                                           const calibration::Calibration& calibration) {
  Result<tracking::Registrar> registrar = tracking::Registrar::create(options_.registration);
  if (!registrar) return tl::unexpected(registrar.error());
  if (auto done = read_frames(recording, calibration, *registrar); !done)
    return tl::unexpected(done.error());
  if (auto done = settle_views(*registrar, &calibration); !done)
    return tl::unexpected(done.error());
  return finish({aligned_, std::move(texture_frames_), editing::EditStack().state(), &calibration});
}

/// Creates a report for each frame of the stage.
void Run::accept_stage(const io::StoredStage& stage) {
  std::map<FrameIndex, FrameReport> reports;
  for (const io::StoredFrame& frame : stage.frames) {
    reports[frame.frame].reason =
        frame.reason.empty() ? "the case has no data of this frame" : frame.reason;
  }
  for (const io::StoredView& stored : stage.views) {
    FrameReport& report = reports[stored.view->frame];
    report.reason.clear();
    report.point_count = stored.view->point_count();
    views_.push_back(stored.view);
  }
  for (const Frame& frame : stage.texture_frames) reports[frame.index].reason.clear();
  for (auto& [frame, report] : reports) {
    report.frame = frame;
    result_.frames.push_back(std::move(report));
  }
}

Result<Reconstruction> Run::from_stage(const io::StoredStage& stage,
                                       const calibration::Calibration& calibration) {
  accept_stage(stage);
  for (const io::StoredView& stored : stage.views) {
    if (!stored.T_world_sensor) continue;
    aligned_.push_back({stored.view, *stored.T_world_sensor});
    report_of(stored.view->frame).fate = FrameFate::kRegistered;
  }
  // Views that are registered anew have another world than the model before.
  const auto held = aligned_.empty() ? nullptr : stage.held;
  if (aligned_.empty()) {
    if (auto done = register_all_views(&calibration); !done) return tl::unexpected(done.error());
  } else {
    for (const io::StoredView& stored : stage.views) {
      if (!stored.T_world_sensor) reject(stored.view->frame, "was not registered");
    }
  }
  return finish({aligned_, stage.texture_frames, stage.edits.state(), &calibration, held});
}

Result<Reconstruction> Run::from_views(std::vector<std::shared_ptr<const View>> views) {
  accept_frames(views.size());
  views_ = std::move(views);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    result_.frames[i].point_count = views_[i]->point_count();
  }
  if (auto done = register_all_views(nullptr); !done) return tl::unexpected(done.error());
  ScannedViews scanned;
  scanned.views = aligned_;
  return finish(std::move(scanned));
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

Result<Reconstruction> reconstruct(const io::Recording& recording,
                                   const calibration::Calibration& calibration,
                                   const ReconstructOptions& options, const Workers& workers,
                                   const Progress& progress) {
  return Run(recording.folder.string(), options, workers, progress)
      .from_recording(recording, calibration);
}

Result<Reconstruction> reconstruct_stage(const NamedStage& stored,
                                         const calibration::Calibration& calibration,
                                         const ReconstructOptions& options, const Workers& workers,
                                         const Progress& progress) {
  return Run(stored.name, options, workers, progress).from_stage(stored.stage, calibration);
}

Result<Reconstruction> reconstruct_views(std::vector<std::shared_ptr<const View>> views,
                                         const ReconstructOptions& options, const Workers& workers,
                                         const Progress& progress) {
  return Run("the views", options, workers, progress).from_views(std::move(views));
}

}  // namespace flytri::reconstruct
