#include "core/pipeline/registrar.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace flytri {
namespace {

/// Views in a row that may fail before other places are searched: motion blur lasts that long.
constexpr int kPassedOver = 2;

RejectReason reason_of(AlignOutcome outcome) {
  switch (outcome) {
    case AlignOutcome::kAligned:
      return RejectReason::kNone;
    case AlignOutcome::kTooFewCrossings:
      return RejectReason::kTooFewCrossings;
    case AlignOutcome::kUndetermined:
      return RejectReason::kUndetermined;
    case AlignOutcome::kPoorFit:
      return RejectReason::kPoorFit;
    case AlignOutcome::kNotConverged:
      return RejectReason::kNotConverged;
  }
  return RejectReason::kPoorFit;
}

/// Share of its way to what the latest view tells that the meter of nearness goes: it shows the
/// mean of about the latest five, as each tries other places.
constexpr double kMeterPace = 0.2;

/// Distance of starts from which the registration finds a pose between them, as a share of the
/// radius: from half of their diagonal it succeeds nine times in ten.
constexpr double kStartSpacingShare = 0.22;

/// About pose_distance_mm, without the angle itself: thousands are compared.
double chord_mm(const Isometry& T_a_b, const Isometry& T_a_c, double arm_mm) {
  const double turned = 0.5 * (T_a_b.linear() - T_a_c.linear()).squaredNorm();
  return std::sqrt((T_a_b.translation() - T_a_c.translation()).squaredNorm() +
                   arm_mm * arm_mm * turned);
}

void append_unless_near(const Isometry& T, double distance_mm, double arm_mm,
                        std::vector<Isometry>& poses) {
  const bool near = std::any_of(poses.begin(), poses.end(), [&](const Isometry& T_known) {
    return chord_mm(T_known, T, arm_mm) < distance_mm;
  });
  if (!near) poses.push_back(T);
}

/// A pose and its neighbors along the surface, from near to far: two steps to each side.
std::vector<Isometry> poses_around(const Isometry& T_world_sensor, double radius_mm) {
  std::vector<Eigen::Array2i> steps;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) steps.emplace_back(i, j);
  }
  std::stable_sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) {
    return a.matrix().squaredNorm() < b.matrix().squaredNorm();
  });
  std::vector<Isometry> poses;
  for (const Eigen::Array2i& step : steps) {
    const Eigen::Vector2d shift_mm = kStartSpacingShare * radius_mm * step.cast<double>().matrix();
    poses.push_back(T_world_sensor * Eigen::Translation3d(shift_mm.x(), shift_mm.y(), 0.0));
  }
  return poses;
}

/// How a hand that comes back may hold the sensor, as twists off a pose it had: as it was; tilted
/// about either axis, to look at a flank; turned about the line of sight; shifted along the
/// surface.
std::vector<Twist> holds(double radius_mm) {
  constexpr double kTilt_rad = 0.4, kTurn_rad = 0.35, kShiftShare = 0.4;
  std::vector<Twist> offs = {Twist::Zero()};
  const auto add = [&](int axis, double amount) {
    for (const double sense : {1.0, -1.0}) offs.push_back(sense * amount * Twist::Unit(axis));
  };
  for (const double tilt_rad : {kTilt_rad, 2.0 * kTilt_rad}) {
    for (const int axis : {0, 1}) add(axis, tilt_rad);
  }
  add(2, kTurn_rad);
  const std::size_t turned = offs.size();
  for (const int axis : {3, 4}) add(axis, kShiftShare * radius_mm);
  for (std::size_t shift = turned; shift < turned + 4; ++shift) {
    for (std::size_t turn = 1; turn < turned; ++turn) offs.push_back(offs[shift] + offs[turn]);
  }
  return offs;
}

/// Poses that a hand may take up a scan from: those of the path, held in each way, the likelier
/// ways first.
std::vector<Isometry> poses_around_path(const std::vector<TrackedView>& views, double radius_mm) {
  std::vector<Isometry> path;
  for (const TrackedView& view : views) {
    append_unless_near(view.aligned.T_world_sensor, 0.35 * radius_mm, radius_mm, path);
  }
  std::vector<Isometry> poses;
  for (const Twist& off : holds(radius_mm)) {
    for (const Isometry& T_world_sensor : path) poses.push_back(T_world_sensor * exp_twist(off));
  }
  return poses;
}

/// True for reasons that no later view can cure.
bool is_final(RejectReason reason) {
  return reason == RejectReason::kTooFewPoints || reason == RejectReason::kTimeNotRising;
}

Result<void> check_range(int value, int low, int high, std::string_view name) {
  if (value >= low && value <= high) return {};
  return fail(ErrorCode::kBadOption, "{} is {}, must be in [{}, {}]", name, value, low, high);
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
      return "time does not come after that of the view before";
    case RejectReason::kNotConnected:
      return "not connected to the rest of the scan";
  }
  return "unknown";
}

Result<void> RegistrarOptions::validate() const {
  if (auto ok = track.validate(); !ok) return ok;
  if (auto ok = check_range(patience_views, 1, 1000, "patience_views"); !ok) return ok;
  if (auto ok = check_range(proposal_pairs, 1, 1000, "proposal_pairs"); !ok) return ok;
  if (auto ok = check_range(starts_per_view, 1, 1000, "starts_per_view"); !ok) return ok;
  if (auto ok = check_range(retry_starts, 1, 100000, "retry_starts"); !ok) return ok;
  if (!(min_entry_evidence >= 0.0 && min_entry_evidence <= 1000.0)) {
    return fail(ErrorCode::kBadOption, "min_entry_evidence is {}, must be in [0, 1000]",
                min_entry_evidence);
  }
  if (auto ok = check_range(register_every, 1, 1000, "register_every"); !ok) return ok;
  if (!(max_gap_s > 0.0)) {
    return fail(ErrorCode::kBadOption, "max_gap_s is {}, must be above 0", max_gap_s);
  }
  return {};
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
  // Counted by pattern: the views that are left still alternate.
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
    added.reason = register_view({view, prepare_view(*view, options_.track.smoothing)});
  }
  if (added.reason != RejectReason::kTimeNotRising) last_time_s_ = view->time_s;
  added_.push_back(added);
  RegisteredView result{view, ViewFate::kRejected, added.reason, Isometry::Identity()};
  if (added.skipped) {
    result.fate = ViewFate::kInterpolated;
    if (!pieces_.empty()) result.T_world_sensor = trajectory().predict(view->time_s).T_world_sensor;
  } else if (added.reason == RejectReason::kNone) {
    result.fate = ViewFate::kRegistered;
    result.T_world_sensor = pieces_[scan_]->views().back().aligned.T_world_sensor;
    result.rms_mm = latest_rms_mm_;
  }
  return result;
}

void Registrar::restore(std::span<const AlignedView> views) {
  for (const AlignedView& aligned : views) {
    IncomingView incoming{aligned.view, prepare_view(*aligned.view, options_.track.smoothing)};
    if (incoming.prepared.profiles.empty()) continue;
    if (pieces_.empty()) {
      radius_mm_ = incoming.prepared.radius_mm;
      pieces_.push_back(std::make_unique<TrackedScan>(options_.track, radius_mm_));
    }
    pieces_[scan_]->add(std::move(incoming), aligned.T_world_sensor);
    added_.push_back({aligned.view, RejectReason::kNone, false});
    last_time_s_ = aligned.view->time_s;
  }
}

void Registrar::start_piece(IncomingView incoming) {
  if (radius_mm_ == 0.0) radius_mm_ = incoming.prepared.radius_mm;
  side_ = pieces_.size();
  pieces_.push_back(std::make_unique<TrackedScan>(options_.track, radius_mm_));
  pieces_.back()->add(std::move(incoming), Isometry::Identity());
}

RejectReason Registrar::register_view(IncomingView incoming) {
  if (incoming.prepared.profiles.empty()) return RejectReason::kTooFewPoints;
  if (pieces_.empty()) {
    start_piece(std::move(incoming));
    return RejectReason::kNone;
  }
  TrackedScan& scan = *pieces_[scan_];
  // After a longer loss a single view is no proof of where the sensor is.
  const bool continues = scan.continues(incoming.view->time_s);
  const Alignment tracked = continues ? scan.track(incoming) : Alignment{};
  if (!tracked.aligned()) {
    if (++lost_views_ == 1) entry_share_ = 0.0;
    // A single bad view is passed over; the search for another place starts when more are lost.
    const bool search = !continues || lost_views_ > kPassedOver;
    return track_lost(std::move(incoming), reason_of(tracked.outcome), search);
  }
  lost_views_ = 0;
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
    const Alignment alignment = pieces_[side_]->track(incoming);
    tracked = alignment.aligned();
    if (tracked) pieces_[side_]->add(incoming, alignment);
  }
  if (!tracked) start_piece(std::move(incoming));
  if (search && try_to_join(side_, pieces_[side_]->size() - 1, false)) return RejectReason::kNone;
  // A piece that outgrows the scan is the scan; what was, may join it.
  if (pieces_[side_]->size() > pieces_[scan_]->size()) {
    std::swap(scan_, side_);
    side_ = scan_;
    lost_views_ = 0;
    claim_.reset();
    return RejectReason::kNone;
  }
  return reason;
}

bool Registrar::convincing(const Alignment& alignment) const {
  return alignment.aligned() && alignment.agreement.evidence >= options_.min_entry_evidence &&
         alignment.rms_mm <= pieces_[scan_]->usual_rms_mm();
}

Isometry Registrar::at_its_depth(const Isometry& T_scan_start, const IncomingView& incoming) const {
  const TrackedView* nearest = nullptr;
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (const TrackedView& view : pieces_[scan_]->views()) {
    const double off_mm = chord_mm(T_scan_start, view.aligned.T_world_sensor, radius_mm_);
    if (view.aligned.view->profiles.empty() || off_mm >= nearest_mm) continue;
    nearest = &view;
    nearest_mm = off_mm;
  }
  if (nearest == nullptr) return T_scan_start;
  const double seen_mm =
      (nearest->aligned.T_world_sensor.inverse() * nearest->placed.center_mm).z();
  return T_scan_start * Eigen::Translation3d(0.0, 0.0, seen_mm - incoming.prepared.center_mm.z());
}

void Registrar::show_nearness(double proof) {
  const double share = std::clamp(proof / std::max(options_.min_entry_evidence, 1e-9), 0.0, 1.0);
  entry_share_ += kMeterPace * (share - entry_share_);
}

std::vector<Isometry> Registrar::anchors(double time_s) const {
  // Where the scan ended, or would be if the hand went on; where it was taken up again; and where
  // the operator was asked to enter.
  std::vector<Isometry> candidates = trajectory().guesses(time_s);
  const std::vector<TimedPose> later = trajectory().between(time_s, time_s + options_.max_gap_s);
  if (!later.empty()) candidates.push_back(later.front().T_world_sensor);
  if (asked_entry_) candidates.insert(candidates.begin(), *asked_entry_);
  if (const auto best = proposal()) candidates.push_back(best->second.T_world_sensor);
  std::vector<Isometry> result;
  for (const Isometry& T_world_sensor : candidates) {
    append_unless_near(T_world_sensor, kStartSpacingShare * radius_mm_, radius_mm_, result);
  }
  return result;
}

std::vector<Isometry> Registrar::start_poses(double time_s, bool all) const {
  const TrackedScan& scan = *pieces_[scan_];
  std::vector<Isometry> near;
  for (const Isometry& T_world_anchor : anchors(time_s)) {
    const std::vector<Isometry> poses = poses_around(T_world_anchor, radius_mm_);
    near.insert(near.end(), poses.begin(), poses.end());
  }
  const std::vector<Isometry> path = poses_around_path(scan.views(), radius_mm_);
  if (all) {
    near.insert(near.end(), path.begin(), path.end());
    near.resize(std::min(near.size(), static_cast<std::size_t>(options_.retry_starts)));
    return near;
  }
  // Live, every view tries where the operator was asked to enter and where the scan ended, and
  // then a few more, going on where the view before stopped: by turns near those places and all
  // over the scan, as nobody has to enter where he was asked to.
  const auto few = static_cast<std::size_t>(options_.starts_per_view);
  std::vector<Isometry> starts = likeliest_entries();
  const std::size_t more = few > starts.size() ? few - starts.size() : 1;
  const std::size_t first = static_cast<std::size_t>(lost_views_) * more;
  for (std::size_t i = first; i < first + more; ++i) {
    const std::vector<Isometry>& among = i % 2 == 0 ? near : path;
    starts.push_back(among[i / 2 % among.size()]);
  }
  return starts;
}

std::vector<Isometry> Registrar::likeliest_entries() const {
  std::vector<Isometry> entries;
  const auto proposed = proposal();
  if (asked_entry_) {
    entries.push_back(*asked_entry_);
  } else if (proposed) {
    entries.push_back(proposed->second.T_world_sensor);
  }
  if (!trajectory().empty()) {
    const TimedPose last = trajectory().before(trajectory().last_time_s(), 1).front();
    append_unless_near(last.T_world_sensor, kStartSpacingShare * radius_mm_, radius_mm_, entries);
  }
  return entries;
}

bool Registrar::confirms_claim(const Alignment& alignment) const {
  return convincing(alignment) && alignment.moved_mm < 0.1 * radius_mm_;
}

bool Registrar::try_to_join(std::size_t piece, std::size_t i, bool all_starts) {
  const TrackedScan& scan = *pieces_[scan_];
  const IncomingView incoming = pieces_[piece]->incoming(i);
  const Isometry T_piece_sensor = pieces_[piece]->views()[i].aligned.T_world_sensor;
  if (claim_ && claim_->piece == piece) {
    const Alignment second = scan.locate(incoming, claim_->T_scan_piece * T_piece_sensor);
    if (confirms_claim(second)) {
      join(piece, second.T_target_source * T_piece_sensor.inverse());
      return true;
    }
  }
  claim_.reset();
  double most_proof = 0.0;
  for (const Isometry& T_scan_start : start_poses(incoming.view->time_s, all_starts)) {
    const Alignment found = scan.locate(incoming, at_its_depth(T_scan_start, incoming));
    most_proof = std::max(most_proof, found.agreement.proof);
    if (!convincing(found)) continue;
    claim_ = {piece, found.T_target_source * T_piece_sensor.inverse()};
    break;
  }
  show_nearness(most_proof);
  return false;
}

void Registrar::join(std::size_t piece, const Isometry& T_scan_piece) {
  TrackedScan& scan = *pieces_[scan_];
  for (std::size_t i = 0; i < pieces_[piece]->size(); ++i) {
    scan.add(pieces_[piece]->incoming(i),
             T_scan_piece * pieces_[piece]->views()[i].aligned.T_world_sensor);
  }
  // Emptied pieces stay as placeholders: the numbers of the others do not change.
  pieces_[piece] = std::make_unique<TrackedScan>(options_.track, radius_mm_);
  lost_views_ = 0;
  side_ = scan_;
  claim_.reset();
}

std::optional<ReentryProposal> Registrar::proposal() const {
  if (pieces_.empty() || pieces_[scan_]->size() < 2) return std::nullopt;
  const std::vector<TrackedView>& views = pieces_[scan_]->views();
  const auto pairs = std::min(views.size() - 1, static_cast<std::size_t>(options_.proposal_pairs));
  ReentryProposal best;
  for (std::size_t i = views.size() - 1; i >= views.size() - pairs; --i) {
    const AlignedView& first = views[i - 1].aligned;
    const AlignedView& second = views[i].aligned;
    const std::size_t points = first.view->point_count() + second.view->point_count();
    if (points > best.point_count) best = {first, second, points};
  }
  return best;
}

std::vector<ReentryProposal> Registrar::proposals(std::size_t count) const {
  std::vector<ReentryProposal> ranked;
  if (const auto best = proposal()) ranked.push_back(*best);
  if (ranked.empty()) return ranked;
  const std::vector<TrackedView>& views = pieces_[scan_]->views();
  std::vector<std::size_t> order(views.size() - 1);
  std::iota(order.begin(), order.end(), std::size_t{1});
  const auto points = [&](std::size_t i) {
    return views[i - 1].aligned.view->point_count() + views[i].aligned.view->point_count();
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points(a) > points(b); });
  for (const std::size_t i : order) {
    if (ranked.size() >= count) break;
    const AlignedView& second = views[i].aligned;
    const bool near = std::any_of(ranked.begin(), ranked.end(), [&](const ReentryProposal& known) {
      return chord_mm(known.second.T_world_sensor, second.T_world_sensor, radius_mm_) < radius_mm_;
    });
    if (!near) ranked.push_back({views[i - 1].aligned, second, points(i)});
  }
  return ranked;
}

ScanGrowth Registrar::take_growth() {
  ScanGrowth growth;
  if (pieces_.empty()) return growth;
  const std::vector<TrackedView>& views = pieces_[scan_]->views();
  growth.is_all = told_piece_ != scan_ || told_views_ > views.size();
  for (std::size_t i = growth.is_all ? 0 : told_views_; i < views.size(); ++i) {
    growth.added.push_back(views[i].aligned);
  }
  told_piece_ = scan_;
  told_views_ = views.size();
  return growth;
}

void Registrar::retire(std::span<const double> times_s) {
  if (pieces_.empty()) return;
  TrackedScan& scan = *pieces_[scan_];
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
  if (pieces_.empty()) return;
  TrackedScan& scan = *pieces_[scan_];
  std::map<double, const AlignedView*> by_time;
  for (const AlignedView& view : refined) by_time[view.view->time_s] = &view;
  // Below this nothing that registers to a view could tell.
  const double negligible_mm = 1e-4 * radius_mm_;
  Isometry T_new_world = Isometry::Identity();  // of the last view that is known
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const AlignedView& view = scan.views()[i].aligned;
    const auto found = by_time.find(view.view->time_s);
    if (found != by_time.end()) {
      T_new_world = found->second->T_world_sensor * view.T_world_sensor.inverse();
    }
    const Isometry T_new_sensor = T_new_world * view.T_world_sensor;
    if (pose_distance_mm(view.T_world_sensor, T_new_sensor, radius_mm_) > negligible_mm) {
      scan.move(i, T_new_sensor);
    }
  }
}

std::vector<AlignedView> Registrar::aligned_views() const {
  std::vector<AlignedView> result;
  if (pieces_.empty()) return result;
  for (const TrackedView& view : pieces_[scan_]->views()) {
    if (!view.aligned.view->profiles.empty()) result.push_back(view.aligned);
  }
  std::sort(result.begin(), result.end(), [](const AlignedView& a, const AlignedView& b) {
    return a.view->time_s < b.view->time_s;
  });
  return result;
}

void Registrar::retry_pieces() {
  // A few views spread over a piece stand for it: each asks all starts, its neighbor confirms.
  constexpr std::size_t kAttempts = 4;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    claim_.reset();
    const std::size_t count = piece == scan_ ? 0 : pieces_[piece]->size();
    for (std::size_t attempt = 0; count >= 2 && attempt < kAttempts; ++attempt) {
      const std::size_t i = attempt * (count - 2) / (kAttempts - 1);
      if (try_to_join(piece, i, true)) break;
      if (claim_ && try_to_join(piece, i + 1, false)) break;
    }
  }
}

void Registrar::retry_rejected() {
  TrackedScan& scan = *pieces_[scan_];
  for (Added& added : added_) {
    if (added.reason == RejectReason::kNone || added.reason == RejectReason::kTooFewPoints)
      continue;
    if (scan.registered_pose(added.view->time_s)) continue;
    const auto T_world_start = trajectory().interpolate(added.view->time_s, options_.max_gap_s);
    if (!T_world_start) continue;
    IncomingView incoming{added.view, prepare_view(*added.view, options_.track.smoothing)};
    const Alignment found = scan.locate(incoming, *T_world_start);
    if (!convincing(found) || found.moved_mm > 0.3 * radius_mm_) continue;
    scan.add(std::move(incoming), found.T_target_source);
  }
}

RegisteredView Registrar::settle(const Added& added) const {
  RegisteredView result{added.view, ViewFate::kRejected, added.reason, Isometry::Identity()};
  if (is_final(added.reason) || pieces_.empty()) return result;
  const double time_s = added.view->time_s;
  if (const auto T_world_sensor = pieces_[scan_]->registered_pose(time_s)) {
    return {added.view, ViewFate::kRegistered, RejectReason::kNone, *T_world_sensor};
  }
  if (added.skipped) {
    if (const auto T_world_sensor = trajectory().interpolate(time_s, options_.max_gap_s)) {
      return {added.view, ViewFate::kInterpolated, RejectReason::kNone, *T_world_sensor};
    }
  }
  const bool elsewhere = std::any_of(pieces_.begin(), pieces_.end(), [&](const auto& piece) {
    return piece->size() >= 2 && piece->registered_pose(time_s).has_value();
  });
  if (elsewhere || result.reason == RejectReason::kNone) {
    result.reason = RejectReason::kNotConnected;
  }
  return result;
}

std::vector<RegisteredView> Registrar::finish(World world) {
  if (!pieces_.empty()) {
    retry_pieces();
    retry_rejected();
  }
  if (!pieces_.empty() && world == World::kFirstView) {
    const Isometry T_world_scan = aligned_views().front().T_world_sensor.inverse();
    pieces_[scan_]->change_frame(T_world_scan);
  }
  std::vector<RegisteredView> result;
  for (const Added& added : added_) result.push_back(settle(added));
  return result;
}

}  // namespace flytri
