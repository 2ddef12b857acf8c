#include "core/scan/growing_scan.h"

#include <utility>

namespace flytri::scan {
namespace {

/// Number of re-entry places to propose.
constexpr std::size_t kReentryPlaces = 5;
/// Distance between the pictures of re-entry places, as a share of the volume's half diagonal.
constexpr double kPictureShare = 0.25;
/// With more tasks waiting for the model, further views are handed over together.
constexpr std::size_t kModelTasks = 4;

double half_diagonal_mm(const calibration::Calibration& calibration) {
  return 0.5 * calibration.volume.size_mm.norm();
}

/// The time between two frames, if it was spent on scanning. Longer gaps were pauses.
double scanned_s_between(double before_s, double after_s) {
  constexpr double kPause_s = 1.0;
  const double gap_s = after_s - before_s;
  return gap_s > 0.0 && gap_s < kPause_s ? gap_s : 0.0;
}

double scanned_s_of(const std::vector<AlignedView>& views) {
  double scanned_s = 0.0;
  for (std::size_t i = 1; i < views.size(); ++i) {
    scanned_s += scanned_s_between(views[i - 1].view->time_s, views[i].view->time_s);
  }
  return scanned_s;
}

}  // namespace

GrowingScan::GrowingScan(std::shared_ptr<const calibration::Calibration> calibration,
                         const LiveScanOptions& options, tracking::Registrar registrar,
                         LiveModel model, const KeptScan& kept, Ask ask)
    : calibration_(std::move(calibration)),
      options_(options),
      ask_(std::move(ask)),
      registrar_(std::make_unique<tracking::Registrar>(std::move(registrar))),
      pictures_(kPictureShare * half_diagonal_mm(*calibration_), half_diagonal_mm(*calibration_)),
      distance_(calibration_->volume.size_mm.z()),
      pattern_shift_(calibration_->volume.size_mm),
      journal_(options.journal, options.now_s),
      background_thread_(options.background),
      refinement_({options.finish.refinement, options.refine_growth, options.min_refine_views},
                  background_thread_, ask_,
                  [this](const std::vector<AlignedView>& refined) {
                    if (run_.valid()) return;
                    take_refined(refined, is_scanning(phase_) ? kToleratedCells : 0.0);
                  }),
      model_(std::move(model),
             {board_, background_thread_, rest_thread_, options.now_s,
              [this](std::vector<double> times_s) {
                ask_([this, times_s = std::move(times_s)] {
                  redundant_s_.insert(redundant_s_.end(), times_s.begin(), times_s.end());
                });
              },
              options.holes_period_s, options.finish.meshing, calibration_->volume.size_mm}),
      finishing_(options.finish, options.now_s) {
  restore(kept);
}

std::size_t GrowingScan::pending() const {
  return model_.pending() + background_thread_.pending() + rest_thread_.pending() +
         finishing_.pending() + journal_.pending();
}

void GrowingScan::cancel_all() const {
  cancel_finish();
  refinement_.cancel();
}

void GrowingScan::stop() {
  journal_.wait_until_idle();
  // Stopped before any is destroyed: they post to each other.
  journal_.stop();
  model_.stop();
  background_thread_.stop();
  rest_thread_.stop();
  finishing_.stop();
}

void GrowingScan::take(const IntakeResult& result, const Arrivals& arrivals) {
  offered_ = arrivals.offered;
  if (is_scanning(phase_)) scanned_s_ += scanned_s_between(last_time_s_, result.frame.time_s);
  last_time_s_ = result.frame.time_s;
  if (result.frame.kind == FrameKind::kTexture) {
    take_texture(result.frame);
  } else if (result.skipped) {
    frame_counter_.skipped();
  } else {
    take_view(result, arrivals.is_late);
  }
  board_.update([&](ScanSnapshot& s) {
    s.counts = frame_counter_.counts(offered_);
    s.time_s = last_time_s_;
    s.scanned_s = scanned_s_;
  });
}

void GrowingScan::take_texture(const Frame& frame) {
  const ImageSize size{frame.image.cols, frame.image.rows};
  if (!(size == calibration_->texture_size) || frame.image.type() != CV_8UC3) {
    return frame_counter_.rejected(frame.time_s,
                                   "texture frame and calibration have different image sizes");
  }
  frame_counter_.textured();
  auto shown = std::make_shared<LiveFrame>();
  shown->frame = frame;
  board_.update([&](ScanSnapshot& s) { s.latest_texture = std::move(shown); });
  if (!is_scanning(phase_)) return;
  journal([frame](ScanJournal& journal) { journal.keep_texture(frame); });
  model_.add_texture(frame);
}

void GrowingScan::take_view(const IntakeResult& result, bool is_late) {
  const double time_s = result.frame.time_s;
  const bool is_measured =
      result.measured && result.measured->outcome == measurement::MeasureOutcome::kMeasured;
  watch_for_rest(is_measured);
  if (!is_measured) {
    show_frame(result, nullptr);
    if (!is_scanning(phase_)) return frame_counter_.previewed();
    board_.update([](ScanSnapshot& s) {
      s.match_share = 0.0;
      s.lost_sensor = {};
    });
    return missed(time_s, result.measured ? std::string(to_string(result.measured->outcome))
                                          : result.measured.error().message);
  }
  auto view = std::make_shared<const View>(result.measured->view);
  show_frame(result, view);
  if (!is_scanning(phase_)) return frame_counter_.previewed();
  journal_view(view);
  register_view(result, view, is_late);
}

void GrowingScan::register_view(const IntakeResult& result, const std::shared_ptr<const View>& view,
                                bool is_late) {
  const tracking::RegisteredView registered =
      is_late ? registrar_->skip(view) : registrar_->add(view);
  switch (registered.fate) {
    case tracking::ViewFate::kRegistered:
      missed_in_a_row_ = 0;
      frame_counter_.registered();
      pictures_.add(result.frame, registered.T_world_sensor);
      board_.update([&](ScanSnapshot& s) {
        s.T_world_sensor = registered.T_world_sensor;
        if (registered.rms_mm > 0.0) s.residual_mm = registered.rms_mm;
      });
      watch_projectors({view, registered.T_world_sensor});
      step(ScanEvent::kRegistered);
      break;
    case tracking::ViewFate::kInterpolated:
      frame_counter_.interpolated();
      break;
    case tracking::ViewFate::kRejected:
      missed(view->time_s, std::string(to_string(registered.reason)));
      break;
  }
  board_.update([&](ScanSnapshot& s) {
    s.match_share = registrar_->entry_share();
    s.lost_sensor = registrar_->lost_sensor();
    s.surface_hold = registrar_->surface_hold();
  });
  hand_over_growth(result.offered_at_s);
}

void GrowingScan::watch_projectors(const AlignedView& registered) {
  pattern_shift_.add(registered);
  constexpr int kEvery = 30;
  if (registered.view->frame.value % kEvery != 0 || board_.snapshot()->moved_projector) return;
  const auto shift = pattern_shift_.shift();
  if (shift && shift->is_large())
    board_.update([&](ScanSnapshot& s) { s.moved_projector = shift; });
}

void GrowingScan::missed(double time_s, const std::string& reason) {
  frame_counter_.rejected(time_s, reason);
  if (++missed_in_a_row_ > options_.registration.patience_views) step(ScanEvent::kLost);
}

void GrowingScan::show_frame(const IntakeResult& result, std::shared_ptr<const View> view) {
  auto shown = std::make_shared<LiveFrame>();
  shown->frame = result.frame;
  if (result.measured) shown->lines = result.measured->lines;
  std::optional<SensorDistance> distance;
  if (view != nullptr) distance = distance_.measure(*view);
  const Pattern pattern =
      view != nullptr ? view->pattern : pattern_of(result.frame.kind).value_or(Pattern::kVertical);
  shown->view = std::move(view);
  board_.update([&](ScanSnapshot& s) {
    s.latest[static_cast<std::size_t>(pattern)] = std::move(shown);
    s.distance = distance;
  });
}

void GrowingScan::hand_over_growth(std::optional<double> offered_at_s) {
  const tracking::ScanGrowth growth = registrar_->take_growth();
  for (const AlignedView& view : growth.added) frame_counter_.found(view.view->time_s);
  known_views_ = growth.is_all ? growth.added.size() : known_views_ + growth.added.size();
  if (growth.is_all) {
    waiting_ = {};
    model_.build_in_other_world(registrar_->aligned_views());
  } else if (!growth.added.empty()) {
    waiting_.views.insert(waiting_.views.end(), growth.added.begin(), growth.added.end());
    if (offered_at_s) waiting_.offered_at_s.push_back(*offered_at_s);
  }
  if (!growth.added.empty()) {
    // A journal that came later lacks the views that were lost at that time.
    for (const auto& view : growth.measured) journal_view(view);
    journal([views = growth.added](ScanJournal& journal) { journal.keep_poses(views); });
  }
  if (waiting_.views.empty()) return;
  if (model_.pending() > kModelTasks) return hand_over_later();
  hand_over_waiting();
  refinement_.run_if_grown(known_views_, [this] { return registrar_->serving_views(); });
  retire_past();
}

void GrowingScan::hand_over_waiting() {
  if (waiting_.views.empty()) return;
  Waiting waiting = std::exchange(waiting_, {});
  model_.add(std::move(waiting.views), std::move(waiting.offered_at_s));
}

/// Hands over when the model's thread is done, in case no further view comes.
void GrowingScan::hand_over_later() {
  if (std::exchange(is_model_asked_, true)) return;
  model_.when_done([this] {
    ask_([this] {
      is_model_asked_ = false;
      hand_over_waiting();
    });
  });
}

/// Retires redundant views, many at a time, once the hand has moved on.
void GrowingScan::retire_past() {
  constexpr double kPast_s = 3.0;
  constexpr std::size_t kAtOnce = 100;
  if (redundant_s_.size() < kAtOnce || redundant_s_[kAtOnce - 1] > last_time_s_ - kPast_s) return;
  registrar_->retire(std::span(redundant_s_).first(kAtOnce));
  redundant_s_.erase(redundant_s_.begin(), redundant_s_.begin() + kAtOnce);
}

void GrowingScan::restore(const KeptScan& kept) {
  registrar_->restore(kept.views);
  edits_ = kept.edits;
  held_ = kept.held;
  known_views_ = kept.views.size();
  for (const AlignedView& view : kept.views) journaled_.insert(view.view->frame);
  if (!kept.views.empty()) last_time_s_ = kept.views.back().view->time_s;
  scanned_s_ = scanned_s_of(kept.views);
  board_.update([&](ScanSnapshot& s) {
    s.restored_views = static_cast<std::int64_t>(kept.views.size());
    s.scanned_s = scanned_s_;
  });
  [[maybe_unused]] const tracking::ScanGrowth known = registrar_->take_growth();
  const bool is_rolling = options_.registration.track.shutter.is_rolling();
  model_.restore(is_rolling ? registrar_->aligned_views() : kept.views, kept.texture_frames,
                 kept.edits);
  show_edits();
  if (kept.result == nullptr) return model_.look_for_holes();
  phase_ = ScanPhase::kFinished;
  board_.update([&](ScanSnapshot& s) {
    s.phase = phase_;
    s.result = kept.result;
  });
  model_.show_holes(kept.result->surface);
}

void GrowingScan::step(ScanEvent event, const std::function<void(ScanSnapshot&)>& also) {
  const ScanPhase next = next_phase(phase_, event, has_model());
  if (next == phase_) return;
  const ScanPhase before = std::exchange(phase_, next);
  missed_in_a_row_ = 0;
  if (next == ScanPhase::kContinuation) show_reentry();
  board_.update([&](ScanSnapshot& s) {
    s.phase = next;
    if (before == ScanPhase::kFinished) s.result = nullptr;
    if (next != ScanPhase::kMeasurement) s.surface_hold = {};
    if (next != ScanPhase::kContinuation) {
      s.reentry.clear();
      s.lost_sensor = {};
      s.chosen_reentry = 0;
    }
    if (also) also(s);
  });
  if (next != ScanPhase::kContinuation && registrar_ != nullptr)
    registrar_->expect_entry_at(std::nullopt);
}

void GrowingScan::show_reentry() {
  std::vector<ReentryPlace> places;
  for (const tracking::ReentryProposal& proposal : registrar_->proposals(kReentryPlaces)) {
    places.push_back({proposal.first, proposal.second, proposal.uncertainty_mm,
                      pictures_.nearest(proposal.second.T_world_sensor)});
  }
  board_.update([&](ScanSnapshot& s) {
    s.reentry = std::move(places);
    s.chosen_reentry = 0;
    s.match_share = 0.0;
  });
}

void GrowingScan::choose_reentry(std::size_t index) {
  const auto now = board_.snapshot();
  if (phase_ != ScanPhase::kContinuation || index >= now->reentry.size()) return;
  end_run_ahead();
  registrar_->expect_entry_at(now->reentry[index].second.T_world_sensor);
  board_.update([&](ScanSnapshot& s) { s.chosen_reentry = index; });
}

void GrowingScan::journal_view(const std::shared_ptr<const View>& view) {
  if (!journaled_.insert(view->frame).second) return;
  journal([view](ScanJournal& journal) { journal.keep_view(*view); });
}

void GrowingScan::start() {
  if (!accepts(phase_, ScanEvent::kStart, has_model())) return;
  end_run_ahead();
  // A sensor that rested has sent no frames.
  seen_at_s_.reset();
  is_away_ = false;
  // Not before: while the user edits, undo and redo need not wait for it.
  registrar_->set_edits(edits_.state());
  step(ScanEvent::kStart);
}

void GrowingScan::pause() {
  if (!accepts(phase_, ScanEvent::kPause, has_model())) return;
  step(ScanEvent::kPause);
  come_to_rest();
  model_.look_for_holes();
}

void GrowingScan::come_to_rest() {
  hand_over_waiting();
  if (run_.valid()) return;
  // A model at rest shows the best poses. An optimization will show better ones at its end, and so
  // will a run ahead.
  if (!ahead_mm_) {
    refinement_.run_if_new(known_views_, [this] { return registrar_->serving_views(); });
    if (!refinement_.is_running()) model_.follow(registrar_->aligned_views(), 0.0);
  }
  begin_run_ahead();
}

/// The user takes the sensor out of the mouth before asking for the result.
void GrowingScan::watch_for_rest(bool sees_surface) {
  constexpr double kAway_s = 2.0;
  if (sees_surface || !seen_at_s_) seen_at_s_ = last_time_s_;
  if (sees_surface) {
    if (std::exchange(is_away_, false) && is_scanning(phase_)) end_run_ahead();
  } else if (!is_away_ && phase_ == ScanPhase::kContinuation &&
             last_time_s_ > *seen_at_s_ + kAway_s) {
    is_away_ = true;
    come_to_rest();
  }
}

void GrowingScan::edit(editing::EditKind kind, std::vector<editing::BrushDab> dabs) {
  if (!accepts(phase_, ScanEvent::kEdit, has_model()) || dabs.empty()) return;
  edits_.push({kind, last_time_s_, std::move(dabs)});
  take_edits();
}

void GrowingScan::change_edits(void (editing::EditStack::*change)()) {
  if (!accepts(phase_, ScanEvent::kEdit, has_model())) return;
  const editing::EditList before = edits_.state();
  (edits_.*change)();
  if (edits_.state() == before) return;
  take_edits();
}

void GrowingScan::take_edits() {
  step(ScanEvent::kEdit);
  show_edits();
  model_.set_edits(edits_);
  end_run_ahead();
  if (is_scanning(phase_)) registrar_->set_edits(edits_.state());
  begin_run_ahead();
}

void GrowingScan::show_edits() {
  board_.update([&](ScanSnapshot& s) {
    s.edits = edits_.state();
    s.can_undo = edits_.can_undo();
    s.can_redo = edits_.can_redo();
  });
  journal([edits = edits_](ScanJournal& journal) { journal.keep_edits(edits); });
}

void GrowingScan::take_refined(const std::vector<AlignedView>& refined, double tolerated_cells) {
  // A rebuilt model contains all views: views handed over after it would be in it twice.
  hand_over_waiting();
  registrar_->apply(refined);
  const std::vector<AlignedView> views = registrar_->aligned_views();
  journal([views](ScanJournal& journal) { journal.keep_poses(views); });
  model_.follow(views, tolerated_cells);
}

void GrowingScan::keep_in(std::shared_ptr<ScanJournal> to) {
  journal_.change(std::move(to));
  const std::vector<AlignedView> views = measured_views();
  journaled_.clear();
  for (const AlignedView& view : views) journaled_.insert(view.view->frame);
  // One entry, so that a long scan does not fill the journal's queue.
  journal([views, edits = edits_, result = board_.snapshot()->result](ScanJournal& journal) {
    constexpr std::size_t kViewsPerCommit = 100;
    for (std::size_t i = 0; i < views.size(); ++i) {
      journal.keep_view(*views[i].view);
      if (i % kViewsPerCommit == kViewsPerCommit - 1) journal.commit();
    }
    journal.keep_poses(views);
    journal.keep_edits(edits);
    if (result != nullptr) journal.keep_result(*result);
  });
  model_.with_textures([this](const std::vector<PlacedTexture>& all) {
    std::vector<Frame> frames;
    frames.reserve(all.size());
    for (const PlacedTexture& placed : all) frames.push_back(placed.frame);
    journal([frames = std::move(frames)](ScanJournal& journal) {
      for (const Frame& frame : frames) journal.keep_texture(frame);
    });
  });
}

std::shared_ptr<const ScanSnapshot> GrowingScan::snapshot() {
  auto now = board_.snapshot();
  if (now->phase != ScanPhase::kFinishing) return now;
  board_.update([&](ScanSnapshot& s) { s.finishing = finishing_.state(); });
  return board_.snapshot();
}

}  // namespace flytri::scan
