#include "core/tracking/registrar.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::tracking {
namespace {

/// So many views in a row may fail before other places are searched: a short motion blur.
constexpr int kIgnoredViews = 2;

RejectReason reason_of(registration::AlignOutcome outcome) {
  switch (outcome) {
    case registration::AlignOutcome::kAligned:
      return RejectReason::kNone;
    case registration::AlignOutcome::kTooFewCrossings:
      return RejectReason::kTooFewCrossings;
    case registration::AlignOutcome::kUndetermined:
      return RejectReason::kUndetermined;
    case registration::AlignOutcome::kPoorFit:
      return RejectReason::kPoorFit;
    case registration::AlignOutcome::kNotConverged:
      return RejectReason::kNotConverged;
  }
  return RejectReason::kPoorFit;
}

/// Weight of the latest search in entry_share(), because each one finds other places.
constexpr double kEntryShareWeight = 0.5;

void sort_by_time(std::vector<AlignedView>& views) {
  std::sort(views.begin(), views.end(), [](const AlignedView& a, const AlignedView& b) {
    return a.view->time_s < b.view->time_s;
  });
}

/// True for rejections that later views cannot change.
bool is_final(RejectReason reason) {
  return reason == RejectReason::kTooFewPoints || reason == RejectReason::kTimeNotRising;
}

}  // namespace

std::string_view to_string(ViewFate fate) {
  switch (fate) {
    case ViewFate::kRegistered:
      return "registered";
    case ViewFate::kInterpolated:
      return "interpolated";
    case ViewFate::kRejected:
      return "rejected";
  }
  return "unknown";
}

std::string_view to_string(RejectReason reason) {
  switch (reason) {
    case RejectReason::kNone:
      return "none";
    case RejectReason::kTooFewPoints:
      return "too few points";
    case RejectReason::kTooFewCrossings:
      return "too few crossings with other views";
    case RejectReason::kUndetermined:
      return "surface does not determine the pose";
    case RejectReason::kPoorFit:
      return "does not fit the other views";
    case RejectReason::kNotConverged:
      return "registration did not converge";
    case RejectReason::kTimeNotRising:
      return "its time is not later than that of the previous view";
    case RejectReason::kNotConnected:
      return "not connected to the rest of the scan";
  }
  return "unknown";
}

Result<void> RegistrarOptions::validate() const {
  return OptionCheck("RegistrarOptions")
      .nested(track)
      .in_range("patience_views", patience_views, 1, 1000)
      .in_range("proposal_pairs", proposal_pairs, 1, 1000)
      .in_range("search_every", search_every, 1, 1000)
      .in_range("searched_places", searched_places, 1, 1000)
      .in_range("retried_places", retried_places, 1, 1000)
      .in_range("min_entry_evidence", min_entry_evidence, 0.0, 1000.0)
      .in_range("settled_views", settled_views, 1, 1000000)
      .in_range("register_every", register_every, 1, 1000)
      .positive("max_gap_s", max_gap_s)
      .result();
}

Result<Registrar> Registrar::create(const RegistrarOptions& options) {
  if (auto ok = options.validate(); !ok) return tl::unexpected(ok.error());
  return Registrar(options);
}

RegisteredView Registrar::add(const std::shared_ptr<const View>& view) { return take(view, true); }

RegisteredView Registrar::skip(const std::shared_ptr<const View>& view) {
  return take(view, false);
}

RegisteredView Registrar::take(const std::shared_ptr<const View>& view, bool may_register) {
  Added added{view, RejectReason::kNone, false};
  // Counted by pattern, so that the registered views still alternate.
  int& number = pattern_counts_[static_cast<std::size_t>(view->pattern)];
  const bool due = number++ % options_.register_every == 0;
  latest_rms_mm_ = 0.0;
  if (!(view->time_s > last_time_s_)) {
    added.reason = RejectReason::kTimeNotRising;
  } else if (view->point_count() < static_cast<std::size_t>(options_.track.min_points)) {
    added.reason = RejectReason::kTooFewPoints;
  } else if (!may_register || (!due && lost_views_ == 0)) {
    added.skipped = true;
  } else {
    added.reason =
        register_view({view, registration::prepare_view(*view, options_.track.smoothing)});
  }
  if (added.reason != RejectReason::kTimeNotRising) last_time_s_ = view->time_s;
  added_.push_back(added);
  RegisteredView result{view, ViewFate::kRejected, added.reason, Isometry::Identity()};
  if (added.skipped) {
    result.fate = ViewFate::kInterpolated;
    if (!submaps_.empty())
      result.T_world_sensor = trajectory().predict(view->time_s).T_world_sensor;
  } else if (added.reason == RejectReason::kNone) {
    result.fate = ViewFate::kRegistered;
    result.T_world_sensor = submaps_[scan_]->views().back().aligned.T_world_sensor;
    result.rms_mm = latest_rms_mm_;
  }
  return result;
}

void Registrar::restore(std::span<const AlignedView> views) {
  for (const AlignedView& aligned : views) {
    IncomingView incoming{aligned.view,
                          registration::prepare_view(*aligned.view, options_.track.smoothing)};
    if (incoming.prepared.profiles.empty()) continue;
    if (submaps_.empty()) {
      radius_mm_ = incoming.prepared.radius_mm;
      submaps_.push_back(std::make_unique<TrackedScan>(options_.track, radius_mm_));
    }
    submaps_[scan_]->add(std::move(incoming), aligned.T_world_sensor);
    added_.push_back({aligned.view, RejectReason::kNone, false});
    last_time_s_ = aligned.view->time_s;
  }
  if (!submaps_.empty()) submaps_[scan_]->correct_all();
}

void Registrar::set_edits(const editing::EditList& edits) {
  const bool is_same = edits == edits_ || (edits->empty() && edits_->empty());
  if (is_same || submaps_.empty()) return;
  edits_ = edits;
  submaps_[scan_]->set_edits(editing::EditFilter(edits_));
  entry_search_.forget();
}

void Registrar::start_submap(IncomingView incoming) {
  if (radius_mm_ == 0.0) radius_mm_ = incoming.prepared.radius_mm;
  side_ = submaps_.size();
  submaps_.push_back(std::make_unique<TrackedScan>(options_.track, radius_mm_));
  submaps_.back()->add(std::move(incoming), Isometry::Identity());
}

RejectReason Registrar::register_view(IncomingView incoming) {
  if (incoming.prepared.profiles.empty()) return RejectReason::kTooFewPoints;
  if (submaps_.empty()) {
    start_submap(std::move(incoming));
    return RejectReason::kNone;
  }
  TrackedScan& scan = *submaps_[scan_];
  // After a longer loss, a single view does not prove where the sensor is.
  const bool continues = scan.continues(incoming.view->time_s);
  const registration::Alignment tracked =
      continues ? scan.track(incoming) : registration::Alignment{};
  if (!tracked.aligned()) {
    if (++lost_views_ == 1) entry_share_ = 0.0;
    // A single bad view is ignored. The search for another place starts after several lost views.
    const bool search = !continues || lost_views_ > kIgnoredViews;
    return track_lost(std::move(incoming), reason_of(tracked.outcome), search);
  }
  lost_views_ = 0;
  lost_sensor_ = {};
  unsearched_views_ = options_.search_every;
  side_ = scan_;
  claim_.reset();
  latest_rms_mm_ = tracked.rms_mm;
  scan.add(std::move(incoming), tracked);
  if (options_.track.check_path) scan.check_path();
  return RejectReason::kNone;
}

RejectReason Registrar::track_lost(IncomingView incoming, RejectReason reason, bool search) {
  bool tracked = false;
  if (side_ != scan_) {
    const registration::Alignment alignment = submaps_[side_]->track(incoming);
    tracked = alignment.aligned();
    if (tracked) submaps_[side_]->add(incoming, alignment);
  }
  if (!tracked) start_submap(std::move(incoming));
  if (search) {
    const int places = is_search_due() ? options_.searched_places : 0;
    if (try_to_join(side_, submaps_[side_]->size() - 1, places)) return RejectReason::kNone;
  }
  const std::size_t scan_size = submaps_[scan_]->size();
  if (edits_->empty() && scan_size < static_cast<std::size_t>(options_.settled_views) &&
      submaps_[side_]->size() > scan_size) {
    scan_ = side_;  // The previous scan may join it later.
    lost_views_ = 0;
    claim_.reset();
    return RejectReason::kNone;
  }
  return reason;
}

bool Registrar::convincing(const registration::Alignment& alignment) const {
  return alignment.aligned() && alignment.agreement.evidence >= options_.min_entry_evidence &&
         alignment.rms_mm <= submaps_[scan_]->usual_rms_mm();
}

void Registrar::tell_of_search(const registration::Alignment& best) {
  const double needed = std::max(options_.min_entry_evidence, 1e-9);
  const double share = std::clamp(best.agreement.proof / needed, 0.0, 1.0);
  entry_share_ += kEntryShareWeight * (share - entry_share_);
  lost_sensor_ = {};
  if (best.agreement.evidence < options_.track.align.min_evidence) return;
  lost_sensor_.T_world_sensor = best.T_target_source;
  lost_sensor_.is_featureless = best.outcome == registration::AlignOutcome::kUndetermined;
}

/// The next view confirms a claim if its own registration gives the same pose. If the two views are
/// not in the same submap, it must be found near the claimed pose.
bool Registrar::confirm_claim(std::size_t submap, const IncomingView& incoming,
                              const Isometry& T_submap_sensor) {
  const Claim claim = *std::exchange(claim_, std::nullopt);
  const bool is_same = claim.submap == submap;
  const Isometry T_scan_start =
      is_same ? claim.T_scan_submap * T_submap_sensor : claim.T_scan_sensor;
  const double allowed_mm = (is_same ? 0.1 : 0.5) * radius_mm_;
  const registration::Alignment found = submaps_[scan_]->locate(incoming, T_scan_start);
  if (!convincing(found) || found.moved_mm >= allowed_mm) return false;
  join(submap, found.T_target_source * T_submap_sensor.inverse());
  if (!is_same) join(claim.submap, claim.T_scan_submap);
  return true;
}

bool Registrar::try_to_join(std::size_t submap, std::size_t i, int searched_places) {
  const TrackedScan& scan = *submaps_[scan_];
  const IncomingView incoming = submaps_[submap]->incoming(i);
  const Isometry T_submap_sensor = submaps_[submap]->views()[i].aligned.T_world_sensor;
  if (claim_ && confirm_claim(submap, incoming, T_submap_sensor)) return true;
  registration::Alignment best;
  best.agreement.evidence = -std::numeric_limits<double>::infinity();
  const auto claims = [&](const Isometry& T_scan_start) {
    const registration::Alignment found = scan.locate(incoming, T_scan_start);
    if (found.agreement.evidence > best.agreement.evidence) best = found;
    if (!convincing(found)) return false;
    claim_ = {submap, found.T_target_source * T_submap_sensor.inverse(), found.T_target_source};
    return true;
  };
  const std::vector<Isometry> likely =
      EntrySearch::likely(scan, incoming, entry_hints(), radius_mm_);
  if (std::none_of(likely.begin(), likely.end(), claims) && searched_places > 0) {
    const std::vector<Isometry> searched =
        entry_search_.search(scan, likely, points_around(*submaps_[submap], i), radius_mm_,
                             static_cast<std::size_t>(searched_places));
    static_cast<void>(std::any_of(searched.begin(), searched.end(), claims));
    tell_of_search(best);
  }
  return false;
}

/// A search takes as long as several frames. Two views, one of each pattern, show more than one.
bool Registrar::is_search_due() {
  ++unsearched_views_;
  const int patience = submaps_[side_]->size() < 2 ? 2 : 1;
  if (unsearched_views_ < patience * options_.search_every) return false;
  unsearched_views_ = 0;
  return true;
}

void Registrar::join(std::size_t submap, const Isometry& T_scan_submap) {
  TrackedScan& scan = *submaps_[scan_];
  for (std::size_t i = 0; i < submaps_[submap]->size(); ++i) {
    const TrackedView& view = submaps_[submap]->views()[i];
    scan.add(submaps_[submap]->incoming(i), T_scan_submap * view.aligned.T_world_sensor,
             view.uncertainty_mm);
  }
  // An empty submap stays as a placeholder, so that the numbers of the others do not change.
  submaps_[submap] = std::make_unique<TrackedScan>(options_.track, radius_mm_);
  lost_views_ = 0;
  lost_sensor_ = {};
  side_ = scan_;
  claim_.reset();
}

std::optional<ReentryProposal> Registrar::proposal() const {
  if (submaps_.empty()) return std::nullopt;
  return propose_reentry(*submaps_[scan_], options_.proposal_pairs);
}

std::vector<ReentryProposal> Registrar::proposals(std::size_t count) const {
  if (submaps_.empty()) return {};
  return propose_reentries(*submaps_[scan_], options_.proposal_pairs, count, radius_mm_);
}

EntrySearch::Hints Registrar::entry_hints() const {
  const auto proposed = proposal();
  return {asked_entry_, proposed ? std::optional(proposed->second.T_world_sensor) : std::nullopt,
          options_.max_gap_s};
}

ScanGrowth Registrar::take_growth() {
  ScanGrowth growth;
  if (submaps_.empty()) return growth;
  const std::vector<TrackedView>& views = submaps_[scan_]->views();
  growth.is_all = returned_submap_ != scan_ || returned_views_ > views.size();
  for (std::size_t i = growth.is_all ? 0 : returned_views_; i < views.size(); ++i) {
    growth.added.push_back(views[i].aligned);
    growth.measured.push_back(views[i].as_measured());
  }
  returned_submap_ = scan_;
  returned_views_ = views.size();
  return growth;
}

void Registrar::retire(std::span<const double> times_s) {
  if (submaps_.empty()) return;
  TrackedScan& scan = *submaps_[scan_];
  const std::set<double> retired(times_s.begin(), times_s.end());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const View& view = *scan.views()[i].aligned.view;
    if (!view.profiles.empty() && retired.contains(view.time_s)) scan.retire(i);
  }
  for (Added& added : added_) {
    if (retired.contains(added.view->time_s)) added.view = without_points(*added.view);
  }
}

void Registrar::apply(std::span<const AlignedView> refined) {
  if (submaps_.empty()) return;
  TrackedScan& scan = *submaps_[scan_];
  std::map<FrameIndex, const AlignedView*> by_frame;
  for (const AlignedView& view : refined) by_frame[view.view->frame] = &view;
  entry_search_.forget();
  // Smaller changes have no effect on views that register to it.
  const double negligible_mm = 1e-4 * radius_mm_;
  Isometry T_new_world = Isometry::Identity();  // of the last view in `refined`
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const AlignedView& view = scan.views()[i].aligned;
    const auto found = by_frame.find(view.view->frame);
    if (found != by_frame.end()) {
      T_new_world = found->second->T_world_sensor * view.T_world_sensor.inverse();
    }
    const Isometry T_new_sensor = T_new_world * view.T_world_sensor;
    if (trajectory::pose_distance_mm(view.T_world_sensor, T_new_sensor, radius_mm_) >
        negligible_mm) {
      scan.move(i, T_new_sensor);
    }
  }
}

std::vector<AlignedView> Registrar::aligned_views() const {
  return views_with_points([](const TrackedView& view) { return view.aligned; });
}

std::vector<AlignedView> Registrar::measured_views() const {
  return views_with_points([](const TrackedView& view) {
    return AlignedView{view.as_measured(), view.aligned.T_world_sensor};
  });
}

std::vector<AlignedView> Registrar::serving_views() const {
  return views_with_points([](const TrackedView& view) { return view.serving(); });
}

template <typename Form>
std::vector<AlignedView> Registrar::views_with_points(const Form& form) const {
  std::vector<AlignedView> result;
  if (submaps_.empty()) return result;
  for (const TrackedView& tracked : submaps_[scan_]->views()) {
    AlignedView view = form(tracked);
    if (!view.view->profiles.empty()) result.push_back(std::move(view));
  }
  sort_by_time(result);
  return result;
}

void Registrar::change_frame(const Isometry& T_new_world) {
  if (submaps_.empty()) return;
  submaps_[scan_]->change_frame(T_new_world);
  entry_search_.forget();
  claim_.reset();
  returned_views_ = std::numeric_limits<std::size_t>::max();
}

void Registrar::retry_submaps(const Progress& progress) {
  for (std::size_t submap = 0; submap < submaps_.size() && !progress.cancelled(); ++submap) {
    if (submap != scan_) retry_submap(submap);
    progress.advance(1.0 / static_cast<double>(submaps_.size()));
  }
}

/// Searches for a few views spread over the submap; the next view confirms.
void Registrar::retry_submap(std::size_t submap) {
  constexpr std::size_t kAttempts = 4;
  claim_.reset();
  const std::size_t count = submaps_[submap]->size();
  for (std::size_t attempt = 0; count >= 2 && attempt < kAttempts; ++attempt) {
    const std::size_t i = attempt * (count - 2) / (kAttempts - 1);
    if (try_to_join(submap, i, options_.retried_places)) break;
    if (claim_ && try_to_join(submap, i + 1, 0)) break;
  }
}

/// Submaps that do not join are lost, so the largest becomes the scan.
void Registrar::choose_largest_submap(const Progress& progress) {
  const auto largest =
      std::max_element(submaps_.begin(), submaps_.end(),
                       [](const auto& a, const auto& b) { return a->size() < b->size(); });
  if ((*largest)->size() <= submaps_[scan_]->size()) return;
  scan_ = static_cast<std::size_t>(largest - submaps_.begin());
  retry_submaps(progress);
}

void Registrar::retry_rejected(const Progress& progress) {
  for (Added& added : added_) {
    if (progress.cancelled()) return;
    retry_rejected(added);
    progress.advance(1.0 / static_cast<double>(added_.size()));
  }
}

void Registrar::retry_rejected(const Added& added) {
  if (added.reason == RejectReason::kNone || added.reason == RejectReason::kTooFewPoints) return;
  TrackedScan& scan = *submaps_[scan_];
  if (scan.registered_pose(added.view->time_s)) return;
  const auto T_world_start = trajectory().interpolate(added.view->time_s, options_.max_gap_s);
  if (!T_world_start) return;
  IncomingView incoming{added.view,
                        registration::prepare_view(*added.view, options_.track.smoothing)};
  scan.correct(incoming, *T_world_start);
  const registration::Alignment found = scan.locate(incoming, *T_world_start);
  if (!convincing(found) || found.moved_mm > 0.3 * radius_mm_) return;
  scan.add(std::move(incoming), found.T_target_source);
}

RegisteredView Registrar::final_fate(const Added& added) const {
  RegisteredView result{added.view, ViewFate::kRejected, added.reason, Isometry::Identity()};
  if (is_final(added.reason) || submaps_.empty()) return result;
  const double time_s = added.view->time_s;
  if (const auto T_world_sensor = submaps_[scan_]->registered_pose(time_s)) {
    return {added.view, ViewFate::kRegistered, RejectReason::kNone, *T_world_sensor};
  }
  if (added.skipped) {
    if (const auto T_world_sensor = trajectory().interpolate(time_s, options_.max_gap_s)) {
      return {added.view, ViewFate::kInterpolated, RejectReason::kNone, *T_world_sensor};
    }
  }
  const bool elsewhere = std::any_of(submaps_.begin(), submaps_.end(), [&](const auto& submap) {
    return submap->size() >= 2 && submap->registered_pose(time_s).has_value();
  });
  if (elsewhere || result.reason == RejectReason::kNone) {
    result.reason = RejectReason::kNotConnected;
  }
  return result;
}

std::vector<RegisteredView> Registrar::finish(World world, const Progress& progress) {
  if (!submaps_.empty()) {
    const Progress third = progress.part(1.0 / 3.0);
    retry_submaps(third);
    if (world == World::kFirstView) choose_largest_submap(third);
    retry_rejected(third);
  }
  if (!submaps_.empty() && world == World::kFirstView) {
    const Isometry T_world_scan = aligned_views().front().T_world_sensor.inverse();
    submaps_[scan_]->change_frame(T_world_scan);
  }
  std::vector<RegisteredView> result;
  for (const Added& added : added_) result.push_back(final_fate(added));
  return result;
}

}  // namespace flytri::tracking
