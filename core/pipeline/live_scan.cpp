#include "core/pipeline/live_scan.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/task_thread.h"
#include "core/pipeline/frame_intake.h"
#include "core/pipeline/frame_ledger.h"
#include "core/pipeline/journal_thread.h"
#include "core/pipeline/live_model.h"
#include "core/pipeline/model_thread.h"
#include "core/pipeline/reentry_images.h"
#include "core/pipeline/snapshot_board.h"

namespace flytri {
namespace {

/// Re-entry places that are offered.
constexpr std::size_t kReentryPlaces = 5;
/// Pictures of re-entry places are this far apart, as a share of the volume's half diagonal.
constexpr double kPictureShare = 0.25;
/// Tasks that may wait for the model before further views are handed over together.
constexpr std::size_t kModelTasks = 4;
/// While the hand scans, better poses wait until they move the surface by so much of a cell: to
/// build it anew takes as long as to build it once, and less is not seen.
constexpr double kToleratedCells = 0.2;

double half_diagonal_mm(const Calibration& calibration) {
  return 0.5 * calibration.volume.size_mm.norm();
}

}  // namespace

/// Everything of a scan. Members are grouped by the thread that owns them.
class LiveScan::Impl {
 public:
  Impl(std::shared_ptr<const Calibration> calibration, const LiveScanOptions& options,
       Registrar registrar, LiveModel model, const KeptScan& kept);
  ~Impl();

  void offer(Frame frame);
  void ask(std::function<void()> wish);
  void start() { step(ScanEvent::kStart); }
  void pause();
  void edit(EditKind kind, std::vector<BrushDab> dabs);
  void change_edits(void (EditStack::*change)());
  void choose_reentry(std::size_t index);
  void keep_in(std::shared_ptr<ScanJournal> journal);
  void finish();
  void cancel_finish() const { finishing().cancel(); }
  std::shared_ptr<const ScanSnapshot> snapshot();
  void wait_until_idle() const;

 private:
  // Measuring threads.
  void measure_frames();
  [[nodiscard]] Result<MeasuredView> measure(const Frame& frame) const;

  // Registering thread.
  void track_frames();
  bool do_wishes();
  void take(const IntakeResult& result);
  void take_texture(const Frame& frame);
  void take_view(const IntakeResult& result);
  void register_view(const IntakeResult& result, const std::shared_ptr<const View>& view);
  void missed(double time_s, const std::string& reason);
  void show_frame(const IntakeResult& result, std::shared_ptr<const View> view);
  void hand_over_growth(std::optional<double> offered_at_s);
  void restore(const KeptScan& kept);
  void step(ScanEvent event);
  void show_reentry();
  void show_edits();
  void refine_if_grown(double factor);
  void take_refined(const std::vector<AlignedView>& refined);
  void retire_past();
  void take_result(Result<FinishedScan> finished);
  void rebuild();
  [[nodiscard]] bool has_model() const { return known_views_ > 0; }
  [[nodiscard]] Progress finishing() const {
    const std::lock_guard lock(finishing_mutex_);
    return finishing_;
  }

  // Finishing thread.
  void run_finishing(std::vector<Frame> textures);

  // Any thread.
  void journal(JournalThread::Entry entry) { journal_.write(std::move(entry)); }

  const std::shared_ptr<const Calibration> calibration_;
  const LiveScanOptions options_;

  // Thread-safe by themselves.
  FrameIntake intake_;
  SnapshotBoard board_;
  std::atomic<std::int64_t> offered_{0};
  std::atomic<bool> tracking_{false};  ///< the registering thread is at work
  std::atomic<bool> stopping_{false};
  Progress beside_;  ///< cancelled when all ends

  mutable std::mutex finishing_mutex_;
  Progress finishing_;  ///< of the latest finishing

  mutable std::mutex wishes_mutex_;
  std::vector<std::function<void()>> wishes_;  ///< for the registering thread

  // Of the registering thread. While finishing, the registrar is the finishing thread's.
  Registrar registrar_;
  ScanPhase phase_ = ScanPhase::kPreview;
  FrameLedger ledger_;
  EditStack edits_;
  ReentryImages pictures_;
  std::vector<AlignedView> unposted_;
  std::vector<double> redundant_s_;  ///< times of views that are to be let go
  std::size_t known_views_ = 0;      ///< registered
  std::size_t refined_views_ = 0;    ///< when the last optimization began
  bool refining_ = false;
  int missed_in_a_row_ = 0;
  double last_time_s_ = 0.0, scanned_s_ = 0.0;
  std::size_t best_points_ = 0;

  // Of the user's thread.
  std::string finishing_step_;
  double finishing_step_since_s_ = 0.0;

  // Destroyed first: nothing of the above is used by a thread that has ended.
  JournalThread journal_;
  TaskThread background_thread_{TaskThread::Priority::kBackground};
  ModelThread model_;
  TaskThread finishing_thread_;
  std::vector<std::thread> measuring_threads_;
  std::thread registering_thread_;
};

LiveScan::Impl::Impl(std::shared_ptr<const Calibration> calibration, const LiveScanOptions& options,
                     Registrar registrar, LiveModel model, const KeptScan& kept)
    : calibration_(std::move(calibration)),
      options_(options),
      intake_(static_cast<std::size_t>(options.max_frames_underway)),
      registrar_(std::move(registrar)),
      pictures_(kPictureShare * half_diagonal_mm(*calibration_), half_diagonal_mm(*calibration_)),
      journal_(options.journal, options.now_s),
      model_(std::move(model), {board_, background_thread_, options.now_s,
                                [this](std::vector<double> times_s) {
                                  ask([this, times_s = std::move(times_s)] {
                                    redundant_s_.insert(redundant_s_.end(), times_s.begin(),
                                                        times_s.end());
                                  });
                                },
                                options.holes_period_s, options.finish.meshing}) {
  restore(kept);
  for (int i = 0; i < options_.measure_threads; ++i) {
    measuring_threads_.emplace_back([this] { measure_frames(); });
  }
  registering_thread_ = std::thread([this] { track_frames(); });
}

LiveScan::Impl::~Impl() {
  stopping_ = true;
  cancel_finish();
  beside_.cancel();
  intake_.close();
  registering_thread_.join();
  for (std::thread& thread : measuring_threads_) thread.join();
  journal_.wait_until_idle();
  // Stopped before any is destroyed: they post to each other.
  journal_.stop();
  model_.stop();
  background_thread_.stop();
  finishing_thread_.stop();
}

void LiveScan::Impl::offer(Frame frame) {
  ++offered_;
  intake_.offer(std::move(frame), options_.now_s());
}

void LiveScan::Impl::ask(std::function<void()> wish) {
  {
    const std::lock_guard lock(wishes_mutex_);
    wishes_.push_back(std::move(wish));
  }
  intake_.wake();
}

Result<MeasuredView> LiveScan::Impl::measure(const Frame& frame) const {
  if (frame.kind == FrameKind::kTexture) return MeasuredView{};
  if (options_.measure_frame) return options_.measure_frame(frame);
  return measure_view(frame, *calibration_, options_.measure);
}

void LiveScan::Impl::measure_frames() {
  while (std::optional<FrameIntake::Task> task = intake_.take()) {
    intake_.deliver(task->number, measure(task->frame));
  }
}

void LiveScan::Impl::track_frames() {
  while (!stopping_) {
    const std::optional<IntakeResult> result = intake_.next();
    tracking_ = true;
    while (do_wishes()) {
    }
    if (result) take(*result);
    tracking_ = false;
  }
}

bool LiveScan::Impl::do_wishes() {
  std::vector<std::function<void()>> wishes;
  {
    const std::lock_guard lock(wishes_mutex_);
    wishes.swap(wishes_);
  }
  for (const auto& wish : wishes) wish();
  return !wishes.empty();
}

void LiveScan::Impl::take(const IntakeResult& result) {
  if (is_scanning(phase_)) scanned_s_ += std::max(0.0, result.frame.time_s - last_time_s_);
  last_time_s_ = result.frame.time_s;
  if (result.frame.kind == FrameKind::kTexture) {
    take_texture(result.frame);
  } else if (result.skipped) {
    ledger_.skipped();
  } else {
    take_view(result);
  }
  board_.update([&](ScanSnapshot& s) {
    s.counts = ledger_.counts(offered_);
    s.time_s = last_time_s_;
    s.scanned_s = scanned_s_;
  });
}

void LiveScan::Impl::take_texture(const Frame& frame) {
  const ImageSize size{frame.image.cols, frame.image.rows};
  if (!(size == calibration_->texture_size) || frame.image.type() != CV_8UC3) {
    return ledger_.rejected(frame.time_s, "texture frame of another size than the calibration's");
  }
  ledger_.textured();
  auto shown = std::make_shared<LiveFrame>();
  shown->frame = frame;
  board_.update([&](ScanSnapshot& s) { s.latest_texture = std::move(shown); });
  if (!is_scanning(phase_)) return;
  journal([frame](ScanJournal& journal) { journal.keep_texture(frame); });
  model_.add_texture(frame);
}

/// A frame that was measured, whatever came of it.
void LiveScan::Impl::take_view(const IntakeResult& result) {
  const double time_s = result.frame.time_s;
  if (!result.measured || result.measured->outcome != MeasureOutcome::kMeasured) {
    show_frame(result, nullptr);
    if (!is_scanning(phase_)) return ledger_.previewed();
    board_.update([](ScanSnapshot& s) { s.match_share = 0.0; });
    return missed(time_s, result.measured ? std::string(to_string(result.measured->outcome))
                                          : result.measured.error().message);
  }
  auto view = std::make_shared<const View>(result.measured->view);
  show_frame(result, view);
  if (!is_scanning(phase_)) return ledger_.previewed();
  journal([view](ScanJournal& journal) { journal.keep_view(*view); });
  register_view(result, view);
}

void LiveScan::Impl::register_view(const IntakeResult& result,
                                   const std::shared_ptr<const View>& view) {
  const bool late = intake_.backlog() > static_cast<std::size_t>(options_.max_views_waiting);
  const RegisteredView registered = late ? registrar_.skip(view) : registrar_.add(view);
  switch (registered.fate) {
    case ViewFate::kRegistered:
      missed_in_a_row_ = 0;
      ledger_.registered();
      pictures_.add(result.frame, registered.T_world_sensor);
      board_.update([&](ScanSnapshot& s) {
        s.T_world_sensor = registered.T_world_sensor;
        if (registered.rms_mm > 0.0) s.residual_mm = registered.rms_mm;
      });
      step(ScanEvent::kRegistered);
      break;
    case ViewFate::kInterpolated:
      ledger_.interpolated();
      break;
    case ViewFate::kRejected:
      missed(view->time_s, std::string(to_string(registered.reason)));
      break;
  }
  board_.update([&](ScanSnapshot& s) { s.match_share = registrar_.entry_share(); });
  hand_over_growth(result.offered_at_s);
}

void LiveScan::Impl::missed(double time_s, const std::string& reason) {
  ledger_.rejected(time_s, reason);
  if (++missed_in_a_row_ > options_.registration.patience_views) step(ScanEvent::kLost);
}

void LiveScan::Impl::show_frame(const IntakeResult& result, std::shared_ptr<const View> view) {
  auto shown = std::make_shared<LiveFrame>();
  shown->frame = result.frame;
  if (result.measured) shown->lines = result.measured->lines;
  std::optional<SensorDistance> distance;
  if (view != nullptr) {
    double sum_mm = 0.0;
    for (const Profile& profile : view->profiles) {
      for (const ProfilePoint& point : profile.points) sum_mm += point.position_mm.z();
    }
    const std::size_t count = view->point_count();
    best_points_ = std::max(best_points_, count);
    distance = {sum_mm / static_cast<double>(count) / (0.5 * calibration_->volume.size_mm.z()),
                static_cast<double>(count) / static_cast<double>(best_points_)};
  }
  const Pattern pattern =
      view != nullptr ? view->pattern : pattern_of(result.frame.kind).value_or(Pattern::kVertical);
  shown->view = std::move(view);
  board_.update([&](ScanSnapshot& s) {
    s.latest[static_cast<std::size_t>(pattern)] = std::move(shown);
    s.distance = distance;
  });
}

void LiveScan::Impl::hand_over_growth(std::optional<double> offered_at_s) {
  ScanGrowth growth = registrar_.take_growth();
  if (growth.is_all) unposted_.clear();
  for (const AlignedView& view : growth.added) {
    ledger_.found(view.view->time_s);
    unposted_.push_back(view);
  }
  known_views_ = growth.is_all ? growth.added.size() : known_views_ + growth.added.size();
  if (growth.is_all) {
    unposted_.clear();
    rebuild();
  }
  if (!growth.added.empty()) {
    journal([views = growth.added](ScanJournal& journal) { journal.keep_poses(views); });
  }
  if (unposted_.empty() || model_.pending() > kModelTasks) return;
  model_.add(std::exchange(unposted_, {}), offered_at_s);
  refine_if_grown(options_.refine_growth);
  retire_past();
}

/// Lets go of views that told nothing new, some at a time, and not before the hand has left them.
void LiveScan::Impl::retire_past() {
  constexpr double kPast_s = 3.0;
  constexpr std::size_t kAtOnce = 100;
  if (redundant_s_.size() < kAtOnce || redundant_s_[kAtOnce - 1] > last_time_s_ - kPast_s) return;
  registrar_.retire(std::span(redundant_s_).first(kAtOnce));
  redundant_s_.erase(redundant_s_.begin(), redundant_s_.begin() + kAtOnce);
}

void LiveScan::Impl::restore(const KeptScan& kept) {
  registrar_.restore(kept.views);
  edits_ = kept.edits;
  known_views_ = kept.views.size();
  if (!kept.views.empty()) last_time_s_ = kept.views.back().view->time_s;
  [[maybe_unused]] const ScanGrowth known = registrar_.take_growth();
  model_.restore(kept.views, kept.texture_frames, kept.edits.state());
  show_edits();
}

void LiveScan::Impl::step(ScanEvent event) {
  const ScanPhase next = next_phase(phase_, event, has_model());
  if (next == phase_) return;
  const ScanPhase before = std::exchange(phase_, next);
  missed_in_a_row_ = 0;
  if (next == ScanPhase::kContinuation) show_reentry();
  board_.update([&](ScanSnapshot& s) {
    s.phase = next;
    if (before == ScanPhase::kFinished) s.result = nullptr;
    if (next != ScanPhase::kContinuation) {
      s.reentry.clear();
      s.chosen_reentry = 0;
    }
  });
  if (next != ScanPhase::kContinuation) registrar_.expect_entry_at(std::nullopt);
}

void LiveScan::Impl::show_reentry() {
  std::vector<ReentryPlace> places;
  for (const ReentryProposal& proposal : registrar_.proposals(kReentryPlaces)) {
    places.push_back({proposal.first, proposal.second, proposal.point_count,
                      pictures_.nearest(proposal.second.T_world_sensor)});
  }
  board_.update([&](ScanSnapshot& s) {
    s.reentry = std::move(places);
    s.chosen_reentry = 0;
    s.match_share = 0.0;
  });
}

void LiveScan::Impl::choose_reentry(std::size_t index) {
  const auto now = board_.snapshot();
  if (phase_ != ScanPhase::kContinuation || index >= now->reentry.size()) return;
  registrar_.expect_entry_at(now->reentry[index].second.T_world_sensor);
  board_.update([&](ScanSnapshot& s) { s.chosen_reentry = index; });
}

void LiveScan::Impl::pause() {
  step(ScanEvent::kPause);
  // What was tolerated while the hand scanned is not where it rests.
  model_.follow(registrar_.aligned_views(), edits_.state(), 0.0);
  refine_if_grown(1.0);
  model_.look_for_holes();
}

void LiveScan::Impl::edit(EditKind kind, std::vector<BrushDab> dabs) {
  if (phase_ == ScanPhase::kFinishing || dabs.empty()) return;
  edits_.push({kind, last_time_s_, std::move(dabs)});
  step(ScanEvent::kEdit);
  show_edits();
  model_.edit(edits_.state(), last_time_s_);
}

void LiveScan::Impl::change_edits(void (EditStack::*change)()) {
  if (phase_ == ScanPhase::kFinishing) return;
  const EditList before = edits_.state();
  (edits_.*change)();
  if (edits_.state() == before) return;
  step(ScanEvent::kEdit);
  show_edits();
  rebuild();
}

void LiveScan::Impl::show_edits() {
  board_.update([&](ScanSnapshot& s) {
    s.edits = edits_.state();
    s.can_undo = edits_.can_undo();
    s.can_redo = edits_.can_redo();
  });
  journal([edits = edits_](ScanJournal& journal) { journal.keep_edits(edits); });
}

/// Makes the model anew from all views.
void LiveScan::Impl::rebuild() { model_.build_anew(registrar_.aligned_views(), edits_.state()); }

void LiveScan::Impl::refine_if_grown(double factor) {
  const auto enough = static_cast<std::size_t>(options_.min_refine_views);
  if (refining_ || known_views_ < enough) return;
  if (static_cast<double>(known_views_) <= factor * static_cast<double>(refined_views_)) return;
  refining_ = true;
  refined_views_ = known_views_;
  background_thread_.post([this, views = registrar_.aligned_views()]() mutable {
    const auto refined = refine_jointly(views, options_.finish.refinement, Workers(1), beside_);
    ask([this, done = refined.has_value(), views = std::move(views)] {
      refining_ = false;
      if (done && phase_ != ScanPhase::kFinishing) take_refined(views);
    });
  });
}

void LiveScan::Impl::take_refined(const std::vector<AlignedView>& refined) {
  registrar_.apply(refined);
  const std::vector<AlignedView> views = registrar_.aligned_views();
  journal([views](ScanJournal& journal) { journal.keep_poses(views); });
  model_.follow(views, edits_.state(), is_scanning(phase_) ? kToleratedCells : 0.0);
}

void LiveScan::Impl::finish() {
  if (next_phase(phase_, ScanEvent::kFinish, has_model()) != ScanPhase::kFinishing) return;
  {
    const std::lock_guard lock(finishing_mutex_);
    finishing_ = Progress();
  }
  step(ScanEvent::kFinish);
  board_.update([](ScanSnapshot& s) { s.failure.clear(); });
  model_.with_textures([this](const std::vector<PlacedTexture>& placed) {
    std::vector<Frame> textures;
    textures.reserve(placed.size());
    for (const PlacedTexture& texture : placed) textures.push_back(texture.frame);
    finishing_thread_.post([this, textures] { run_finishing(textures); });
  });
}

/// On the finishing thread, which has the registrar to itself.
void LiveScan::Impl::run_finishing(std::vector<Frame> textures) {
  ScannedViews scanned;
  const Progress progress = finishing();
  progress.begin_stage("Registering what was lost", 0);
  for (const RegisteredView& view : registrar_.finish(Registrar::World::kUnchanged)) {
    if (view.fate == ViewFate::kRejected || view.view->profiles.empty()) continue;
    scanned.views.push_back({view.view, view.T_world_sensor});
  }
  scanned.texture_frames = std::move(textures);
  scanned.edits = edits_.state();
  scanned.calibration = calibration_.get();
  StageClock clock(options_.now_s);
  auto finished = std::make_shared<Result<FinishedScan>>(
      finish_scan(std::move(scanned), options_.finish, Workers(), progress, clock));
  ask([this, finished] { take_result(std::move(*finished)); });
}

void LiveScan::Impl::take_result(Result<FinishedScan> finished) {
  hand_over_growth(std::nullopt);
  // Pieces that were on their own have joined.
  board_.update([&](ScanSnapshot& s) { s.counts = ledger_.counts(offered_); });
  if (!finished) {
    const bool cancelled = finished.error().code == ErrorCode::kCancelled;
    board_.update([&](ScanSnapshot& s) { s.failure = cancelled ? "" : finished.error().message; });
    return step(ScanEvent::kNoResult);
  }
  take_refined(finished->views);
  auto result = std::make_shared<const FinishedScan>(std::move(*finished));
  journal([result](ScanJournal& journal) { journal.keep_result(*result); });
  board_.update([&](ScanSnapshot& s) {
    s.result = result;
    s.holes = result->surface.boundaries;
    s.holes_are_current = true;
  });
  step(ScanEvent::kResult);
}

void LiveScan::Impl::keep_in(std::shared_ptr<ScanJournal> to) {
  journal_.change(std::move(to));
  const std::vector<AlignedView> views = registrar_.aligned_views();
  for (const AlignedView& view : views) {
    journal([view](ScanJournal& journal) { journal.keep_view(*view.view); });
  }
  journal([views](ScanJournal& journal) { journal.keep_poses(views); });
  journal([edits = edits_](ScanJournal& journal) { journal.keep_edits(edits); });
  model_.with_textures([this](const std::vector<PlacedTexture>& all) {
    for (const PlacedTexture& placed : all) {
      journal([frame = placed.frame](ScanJournal& journal) { journal.keep_texture(frame); });
    }
  });
}

std::shared_ptr<const ScanSnapshot> LiveScan::Impl::snapshot() {
  auto now = board_.snapshot();
  if (now->phase != ScanPhase::kFinishing) return now;
  const Progress::Snapshot step = finishing().snapshot();
  if (step.stage != finishing_step_) {
    finishing_step_ = step.stage;
    finishing_step_since_s_ = options_.now_s();
  }
  const double spent_s = options_.now_s() - finishing_step_since_s_;
  constexpr double kTelling = 0.05;  // an earlier guess would jump about
  const double remaining_s =
      step.fraction > kTelling ? spent_s * (1.0 - step.fraction) / step.fraction : -1.0;
  board_.update([&](ScanSnapshot& s) { s.finishing = {step, remaining_s}; });
  return board_.snapshot();
}

void LiveScan::Impl::wait_until_idle() const {
  const auto busy = [this] {
    {
      const std::lock_guard lock(wishes_mutex_);
      if (!wishes_.empty()) return true;
    }
    return tracking_ || board_.snapshot()->counts.pending > 0 ||
           board_.snapshot()->counts.offered < offered_ || model_.pending() > 0 ||
           background_thread_.pending() > 0 || finishing_thread_.pending() > 0 ||
           journal_.pending() > 0;
  };
  // Work moves from thread to thread: idle is what stays idle.
  for (int quiet = 0; quiet < 3; quiet = busy() ? 0 : quiet + 1) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

Result<void> LiveScanOptions::validate() const {
  if (auto valid = measure.validate(); !valid) return valid;
  if (auto valid = registration.validate(); !valid) return valid;
  if (auto valid = surface.validate(); !valid) return valid;
  const auto bad = [](std::string_view name, std::string_view range) {
    return fail(ErrorCode::kBadOption, "LiveScanOptions::{} must be {}", name, range);
  };
  if (measure_threads < 1) return bad("measure_threads", ">= 1");
  if (max_frames_underway < 2) return bad("max_frames_underway", ">= 2");
  if (max_views_waiting < 1) return bad("max_views_waiting", ">= 1");
  if (!(refine_growth > 1.0)) return bad("refine_growth", "> 1");
  if (min_refine_views < 2) return bad("min_refine_views", ">= 2");
  if (!(holes_period_s > 0.0)) return bad("holes_period_s", "> 0");
  if (!now_s) return bad("now_s", "set");
  return {};
}

LiveScan::LiveScan(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveScan::~LiveScan() = default;

Result<std::unique_ptr<LiveScan>> LiveScan::create(std::shared_ptr<const Calibration> calibration,
                                                   const LiveScanOptions& options,
                                                   const KeptScan& kept) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  Result<Registrar> registrar = Registrar::create(options.registration);
  if (!registrar) return tl::unexpected(registrar.error());
  Result<LiveModel> model =
      LiveModel::create(options.surface, *calibration, options.finish.max_gap_s);
  if (!model) return tl::unexpected(model.error());
  return std::unique_ptr<LiveScan>(new LiveScan(std::make_unique<Impl>(
      std::move(calibration), options, std::move(*registrar), std::move(*model), kept)));
}

void LiveScan::offer(Frame frame) { impl_->offer(std::move(frame)); }
void LiveScan::start() {
  impl_->ask([this] { impl_->start(); });
}
void LiveScan::pause() {
  impl_->ask([this] { impl_->pause(); });
}
void LiveScan::edit(EditKind kind, std::vector<BrushDab> dabs) {
  impl_->ask([this, kind, dabs = std::move(dabs)] { impl_->edit(kind, dabs); });
}
void LiveScan::undo() {
  impl_->ask([this] { impl_->change_edits(&EditStack::undo); });
}
void LiveScan::redo() {
  impl_->ask([this] { impl_->change_edits(&EditStack::redo); });
}
void LiveScan::choose_reentry(std::size_t index) {
  impl_->ask([this, index] { impl_->choose_reentry(index); });
}
void LiveScan::finish() {
  impl_->ask([this] { impl_->finish(); });
}
void LiveScan::keep_in(std::shared_ptr<ScanJournal> journal) {
  impl_->ask([this, journal = std::move(journal)] { impl_->keep_in(journal); });
}
void LiveScan::cancel_finish() { impl_->cancel_finish(); }
std::shared_ptr<const ScanSnapshot> LiveScan::snapshot() const { return impl_->snapshot(); }
void LiveScan::wait_until_idle() const { impl_->wait_until_idle(); }

}  // namespace flytri
