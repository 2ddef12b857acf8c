#include "core/tracking/tracked_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/editing/serving_views.h"

namespace flytri::tracking {
namespace {

/// Window of the path check: within it the hand moves smoothly.
constexpr double kPathWindow_s = 0.4;
constexpr std::size_t kMinPathPoses = 8;
/// Aligned views needed to know the usual fit.
constexpr std::size_t kMinAlignedViews = 8;
/// Limit of a usual fit: some times the median RMS, plus this minimum as a share of the radius,
/// because the median of ideal data is almost zero.
constexpr double kUsualSpread = 2.0, kLeastRmsShare = 0.001;
/// Guesses of the next pose that are nearer to each other than this lead to the same fit.
constexpr double kOtherGuessShare = 0.05;
/// Weight of one view in the mean of the latest: about as many as in a quarter of a second.
constexpr double kLatestShare = 0.15;
/// The operator is told from this weakness on: half of a second is enough to turn back.
constexpr double kWeak = 0.5;
/// Crossings to look for where the surface leaves a direction open: each one counts there.
constexpr int kHeldPairs = 2000;
/// The first views see one or two others: too little to weigh their motion against.
constexpr std::size_t kFirstViews = 8;
/// The first view is where it is.
constexpr double kFirstSigma_mm = 1e-3;
/// A held view must fit almost as well as the others, see usual_rms_mm(). In a wrong place, small
/// relief fits a little worse. If several held views drift, each fits worse than the one before.
constexpr double kHeldSpread = 1.15;
constexpr double kLeastHeldRmsShare = 0.0001;
/// A view of a rolling shutter is corrected so often; the last time only after a poor fit.
constexpr int kCorrections = 3;
/// Latest views whose motion a new pose shows more exactly.
constexpr std::size_t kCorrectedAgain = 3;
/// After so many time steps the pose cannot be predicted.
constexpr double kPredictableSteps = 5.5;

registration::ViewExtent extent_of(const registration::PreparedView& placed,
                                   const Isometry& T_world_sensor) {
  return {placed.center_mm, placed.line_direction, T_world_sensor.linear().col(2),
          placed.radius_mm};
}

/// Draws `count` overlaps at random with probability by worth, spread over the whole scan: the ones
/// with the highest keys u^(1/worth).
/// @source  Efraimidis and Spirakis, "Weighted random sampling with a reservoir", 2006.
std::vector<std::size_t> draw_by_worth(const std::vector<registration::Overlap>& overlaps,
                                       std::size_t count, std::uint64_t seed) {
  std::vector<std::pair<double, std::size_t>> keys;
  for (const registration::Overlap& overlap : overlaps) {
    Random random(seed, overlap.view);
    keys.emplace_back(std::log(1.0 - random.uniform()) / overlap.worth, overlap.view);
  }
  count = std::min(count, keys.size());
  std::partial_sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(count), keys.end(),
                    std::greater<>());
  std::vector<std::size_t> views;
  for (std::size_t i = 0; i < count; ++i) views.push_back(keys[i].second);
  std::sort(views.begin(), views.end());
  return views;
}

}  // namespace

Result<void> TrackOptions::validate() const {
  return OptionCheck("TrackOptions")
      .nested(align)
      .nested(smoothing)
      .at_least("locate_pairs", locate_pairs, 20)
      .at_least("single_views", single_views, 1)
      .at_least("metaview_views", metaview_views, 1)
      .at_least("min_points", min_points, 6)
      .positive_up_to("max_surprise_share", max_surprise_share, 5.0)
      .in_range("max_held_share", max_held_share, 0.0, 1.0)
      .must("shutter.row_share", shutter.readout_s,
            !shutter.is_rolling() || shutter.row_share != nullptr, "set for a rolling shutter")
      .result();
}

TrackedScan::TrackedScan(const TrackOptions& options, double radius_mm)
    : options_(options),
      radius_mm_(std::max(radius_mm, 1e-6)),
      grid_(radius_mm_),
      trajectory_(radius_mm_),
      motion_(radius_mm_) {}

IncomingView TrackedScan::incoming(std::size_t i) const {
  const AlignedView& aligned = views_[i].aligned;
  return {aligned.view, views_[i].placed.moved(aligned.T_world_sensor.inverse()),
          views_[i].measured};
}

void TrackedScan::add(IncomingView incoming, const Isometry& T_world_sensor,
                      double uncertainty_mm) {
  TrackedView view{{std::move(incoming.view), T_world_sensor},
                   incoming.prepared.moved(T_world_sensor),
                   uncertainty_mm};
  view.measured = std::move(incoming.measured);
  if (views_.empty()) {
    motion_.add({view.aligned.view->time_s, T_world_sensor, incoming.prepared.center_mm,
                 Matrix6::Identity() / (kFirstSigma_mm * kFirstSigma_mm), false});
  }
  grid_.add(extent_of(view.placed, T_world_sensor));
  trajectory_.set(view.aligned.view->time_s, T_world_sensor);
  views_.push_back(std::move(view));
  if (edits_.empty()) return;
  cut(views_.back(),
      editing::serving_views({&views_.back().aligned, 1}, edits_, Workers(1)).front().view);
  locate_extent(views_.size() - 1);
}

void TrackedScan::add(IncomingView incoming, const registration::Alignment& alignment) {
  motion_.add({incoming.view->time_s, alignment.T_target_source, incoming.prepared.center_mm,
               alignment.information, alignment.is_held});
  ++averaged_views_;
  const double share = std::max(kLatestShare, 1.0 / static_cast<double>(averaged_views_));
  latest_information_ += share * (alignment.information - latest_information_);
  add(std::move(incoming), alignment.T_target_source, alignment.uncertainty_mm);
  if (!alignment.is_held) rms_mm_.push_back(alignment.rms_mm);
  if (!options_.shutter.is_rolling()) return;
  // The new pose shows the motion at the poses before more exactly.
  for (std::size_t i = views_.size() - std::min(views_.size(), kCorrectedAgain); i < views_.size();
       ++i)
    correct_again(i);
}

double TrackedScan::usual_rms_mm() const { return usual_rms_mm(kUsualSpread, kLeastRmsShare); }

double TrackedScan::usual_rms_mm(double spread, double least_share) const {
  if (rms_mm_.size() < kMinAlignedViews) return std::numeric_limits<double>::infinity();
  const std::size_t count = std::min(rms_mm_.size(), 4 * kMinAlignedViews);
  std::vector<double> latest(rms_mm_.end() - static_cast<std::ptrdiff_t>(count), rms_mm_.end());
  return spread * median_of(latest) + least_share * radius_mm_;
}

SurfaceHold TrackedScan::surface_hold() const {
  SurfaceHold hold;
  if (averaged_views_ < kMinAlignedViews) return hold;
  const auto eigen = symmetric_eigen(latest_information_);
  const double sigma_mm = 1.0 / std::sqrt(std::max(eigen.values[0], 1e-6));
  hold.weakness = sigma_mm / (options_.align.max_uncertainty_share * radius_mm_);
  hold.is_weak = hold.weakness > kWeak;
  const Twist open = eigen.vectors.col(0);
  const bool is_turn = open.head<3>().norm() > open.tail<3>().norm();
  hold.direction = {views_.back().placed.center_mm,
                    (is_turn ? open.head<3>() : open.tail<3>()).normalized(), is_turn};
  return hold;
}

bool TrackedScan::continues(double time_s) const {
  const std::vector<trajectory::TimedPose> latest = trajectory_.before(time_s, 12);
  if (latest.empty()) return false;
  if (latest.size() < 3) return true;
  const double mean_step_s =
      (latest.back().time_s - latest.front().time_s) / static_cast<double>(latest.size() - 1);
  return time_s - latest.back().time_s < kPredictableSteps * mean_step_s;
}

std::optional<Isometry> TrackedScan::registered_pose(double time_s) const {
  const std::vector<trajectory::TimedPose> found = trajectory_.between(time_s, time_s);
  return found.empty() ? std::nullopt : std::optional(found.front().T_world_sensor);
}

void TrackedScan::change_frame(const Isometry& T_new_world) {
  for (std::size_t i = 0; i < views_.size(); ++i) {
    move(i, T_new_world * views_[i].aligned.T_world_sensor);
  }
}

void TrackedScan::move(std::size_t i, const Isometry& T_world_sensor) {
  TrackedView& view = views_[i];
  const Isometry T_new_world = T_world_sensor * view.aligned.T_world_sensor.inverse();
  if (view.placed_whole) view.placed_whole = view.placed_whole->moved(T_new_world);
  view.aligned.T_world_sensor = T_world_sensor;
  if (!view.placed.profiles.empty()) {
    view.placed = view.placed.moved(T_new_world);
    locate_extent(i);
  }
  trajectory_.set(view.aligned.view->time_s, T_world_sensor);
  motion_.move(view.aligned.view->time_s, T_world_sensor);
}

void TrackedScan::locate_extent(std::size_t i) {
  const TrackedView& view = views_[i];
  if (view.placed.profiles.empty()) {
    grid_.remove(i);
  } else {
    grid_.move(i, extent_of(view.placed, view.aligned.T_world_sensor));
  }
}

void TrackedScan::retire(std::size_t i) {
  TrackedView& view = views_[i];
  view.part = nullptr;
  view.measured = nullptr;
  view.placed_whole.reset();
  view.aligned.view = without_points(*view.aligned.view);
  view.placed = registration::PreparedView{};
  grid_.remove(i);
}

std::vector<const registration::PreparedView*> TrackedScan::latest_views() const {
  std::vector<const registration::PreparedView*> result;
  const auto count = std::min(views_.size(), static_cast<std::size_t>(options_.single_views));
  for (std::size_t i = views_.size() - count; i < views_.size(); ++i) {
    result.push_back(&views_[i].placed);
  }
  return result;
}

std::vector<const registration::PreparedView*> TrackedScan::metaview(const IncomingView& incoming,
                                                                     const Isometry& T_world_sensor,
                                                                     std::size_t skip_view) const {
  registration::ViewExtent around = extent_of(incoming.prepared, T_world_sensor);
  around.center_mm = T_world_sensor * around.center_mm;
  around.line_direction = T_world_sensor.linear() * around.line_direction;
  std::vector<registration::Overlap> overlaps = grid_.overlapping(around);
  std::erase_if(overlaps,
                [&](const registration::Overlap& overlap) { return overlap.view == skip_view; });
  const std::uint64_t seed = options_.align.seed + views_.size();
  std::vector<const registration::PreparedView*> result;
  for (const std::size_t i :
       draw_by_worth(overlaps, static_cast<std::size_t>(options_.metaview_views), seed)) {
    result.push_back(&views_[i].placed);
  }
  return result;
}

registration::Alignment TrackedScan::align(
    const IncomingView& incoming, const std::vector<const registration::PreparedView*>& metaview,
    const Isometry& T_world_guess, const registration::AlignOptions& options) const {
  // The options were validated before, so an error cannot occur.
  return registration::align_to_metaview(incoming.prepared, metaview, T_world_guess, options)
      .value_or(registration::Alignment{});
}

registration::Alignment TrackedScan::track(IncomingView& incoming) const {
  // Two views that the same motion distorts fit each other; only then is the motion known.
  if (!options_.shutter.is_rolling() || views_.size() < 2) return track_as_it_is(incoming);
  registration::Alignment result;
  for (const Isometry& T_world_expected : moved_on(incoming.view->time_s)) {
    result = track_corrected(incoming, T_world_expected);
    if (result.aligned()) break;
  }
  return result;
}

/// Corrects a view by the pose at which it is expected, then by the one that is found.
registration::Alignment TrackedScan::track_corrected(IncomingView& incoming,
                                                     Isometry T_world_sensor) const {
  registration::Alignment result;
  for (int i = 0; i < kCorrections; ++i) {
    correct(incoming, T_world_sensor);
    const bool was_aligned = result.aligned();
    result = track_as_it_is(incoming);
    if (was_aligned) break;
    // Even a pose that does not fit well shows the motion better than none.
    if (!result.aligned() && result.outcome != registration::AlignOutcome::kPoorFit) break;
    T_world_sensor = result.T_target_source;
  }
  return result;
}

registration::Alignment TrackedScan::track_as_it_is(const IncomingView& incoming) const {
  const trajectory::PosePrediction prediction = trajectory_.predict(incoming.view->time_s);
  registration::Alignment result = track_from(incoming, prediction);
  if (result.outcome == registration::AlignOutcome::kUndetermined) {
    if (registration::Alignment held = hold(incoming); held.aligned()) return held;
  }
  // If the prediction was wrong, try other guesses.
  std::vector<Isometry> tried = {prediction.T_world_sensor};
  for (const Isometry& T_world_guess : trajectory_.guesses(incoming.view->time_s)) {
    if (result.aligned()) break;
    const bool known = std::any_of(tried.begin(), tried.end(), [&](const Isometry& T) {
      return trajectory::pose_distance_mm(T, T_world_guess, radius_mm_) <
             kOtherGuessShare * radius_mm_;
    });
    if (known) continue;
    tried.push_back(T_world_guess);
    const registration::Alignment other = track_from(incoming, {T_world_guess, prediction.prior});
    if (other.aligned()) result = other;
  }
  return result;
}

registration::Alignment TrackedScan::hold(const IncomingView& incoming) const {
  if (options_.max_held_share <= 0.0 || views_.size() < kFirstViews) return {};
  const auto prediction = motion_.predict(incoming.view->time_s, incoming.prepared.center_mm);
  if (!prediction) return {};
  registration::AlignOptions held = options_.align;
  held.coarse_pairs = 0;
  held.fine_pairs = std::max(held.fine_pairs, kHeldPairs);
  held.max_uncertainty_share = options_.max_held_share;
  held.known = registration::KnownPose{prediction->T_world_sensor,
                                       inverse_of_symmetric(prediction->covariance)};
  const auto seen = metaview(incoming, prediction->T_world_sensor, kSkipNone);
  const auto eigen = symmetric_eigen(prediction->covariance);
  const Twist open_mm = std::sqrt(eigen.values[5]) * eigen.vectors.col(5);
  const double usual_mm = usual_rms_mm(kHeldSpread, kLeastHeldRmsShare);
  registration::Alignment best;
  for (const double sigmas : {0.0, -1.0, 1.0, -2.0, 2.0}) {
    const Isometry T_world_start =
        registration::motion_of(sigmas * open_mm, {prediction->center_mm, radius_mm_}) *
        prediction->T_world_sensor;
    registration::Alignment found = align(incoming, seen, T_world_start, held);
    found.is_held = true;
    if (found.aligned() && (!best.aligned() || found.rms_mm < best.rms_mm)) best = found;
    if (best.aligned() && best.rms_mm <= usual_mm) return best;
  }
  // Small relief fits in a wrong place, too, but not as well.
  return {};
}

registration::Alignment TrackedScan::track_from(
    const IncomingView& incoming, const trajectory::PosePrediction& prediction) const {
  registration::AlignOptions single = options_.align;
  single.prior = prediction.prior;
  single.fine_pairs = single.coarse_pairs;
  single.coarse_pairs = 0;  // one stage: this only gives the start for the metaview
  registration::Alignment first =
      align(incoming, latest_views(), prediction.T_world_sensor, single);

  registration::AlignOptions multi = options_.align;
  multi.prior = prediction.prior;
  const Isometry T_world_guess =
      first.aligned() ? first.T_target_source : prediction.T_world_sensor;
  if (first.aligned()) {
    multi.start_distance_share =
        std::max(multi.final_distance_share, 0.5 * multi.start_distance_share);
    multi.coarse_pairs = 0;
  }
  registration::Alignment second =
      align(incoming, metaview(incoming, T_world_guess, kSkipNone), T_world_guess, multi);
  const registration::Alignment& better = second.aligned() || !first.aligned() ? second : first;
  registration::Alignment result = better;
  result.moved_mm =
      trajectory::pose_distance_mm(prediction.T_world_sensor, result.T_target_source, radius_mm_);
  const double allowed_mm =
      options_.max_surprise_share * radius_mm_ + 3.0 * prediction.prior.translation_mm;
  if (result.aligned() && (result.moved_mm > allowed_mm || result.rms_mm > 1.5 * usual_rms_mm())) {
    result.outcome = registration::AlignOutcome::kPoorFit;
  }
  return result;
}

registration::Alignment TrackedScan::locate(const IncomingView& incoming,
                                            const Isometry& T_world_start) const {
  registration::AlignOptions wide = options_.align;
  wide.coarse_pairs = options_.locate_pairs;
  wide.fine_pairs = std::max(wide.fine_pairs, wide.coarse_pairs);
  registration::Alignment coarse =
      align(incoming, metaview(incoming, T_world_start, kSkipNone), T_world_start, wide);
  if (!coarse.aligned()) return coarse;
  registration::Alignment fine =
      align(incoming, metaview(incoming, coarse.T_target_source, kSkipNone), coarse.T_target_source,
            options_.align);
  fine.moved_mm = trajectory::pose_distance_mm(T_world_start, fine.T_target_source, radius_mm_);
  return fine;
}

double TrackedScan::uncertainty_mm(std::size_t i) {
  TrackedView& view = views_[i];
  if (!std::isnan(view.uncertainty_mm)) return view.uncertainty_mm;
  const IncomingView again = incoming(i);
  const Isometry& T_world_sensor = view.aligned.T_world_sensor;
  registration::AlignOptions at_rest = options_.align;
  at_rest.coarse_pairs = 0;
  const registration::Alignment found =
      align(again, metaview(again, T_world_sensor, i), T_world_sensor, at_rest);
  view.uncertainty_mm =
      found.aligned() ? found.uncertainty_mm : std::numeric_limits<double>::infinity();
  return view.uncertainty_mm;
}

void TrackedScan::check_path() {
  if (views_.empty()) return;
  const double now_s = trajectory_.last_time_s();
  const std::vector<trajectory::TimedPose> window =
      trajectory_.between(now_s - kPathWindow_s, now_s);
  if (window.size() < kMinPathPoses) return;
  trajectory::OutlierOptions ransac;
  ransac.arm_mm = radius_mm_;
  ransac.min_deviation_mm = 0.05 * radius_mm_;
  ransac.seed = options_.align.seed;
  const trajectory::PathOutliers found = trajectory::find_outliers(window, ransac);
  for (const std::size_t outlier : found.outliers) {
    const double time_s = window[outlier].time_s;
    const auto view = std::find_if(views_.rbegin(), views_.rend(), [&](const TrackedView& v) {
      return v.aligned.view->time_s == time_s;
    });
    if (view == views_.rend() || view->confirmed) continue;
    reregister(static_cast<std::size_t>(views_.rend() - view) - 1, found.curve.at(time_s));
  }
}

void TrackedScan::reregister(std::size_t i, const Isometry& T_world_curve) {
  const IncomingView again = incoming(i);
  const Isometry& T_world_sensor = views_[i].aligned.T_world_sensor;
  const auto fit_from = [&](const Isometry& T_world_start,
                            const registration::AlignOptions& options) {
    return align(again, metaview(again, T_world_start, i), T_world_start, options);
  };
  const auto fits = [&](const registration::Alignment& alignment) {
    return alignment.aligned() && alignment.rms_mm <= usual_rms_mm();
  };
  // The hand may turn sharply: a view that fits at its present pose is not an outlier, and a fit
  // nearer to the curve may be a coincidence.
  registration::AlignOptions at_rest = options_.align;
  at_rest.start_distance_share = 0.5 * at_rest.start_distance_share;
  at_rest.coarse_pairs = 0;
  views_[i].confirmed = fits(fit_from(T_world_sensor, at_rest));
  if (views_[i].confirmed) return;
  const registration::Alignment anew = fit_from(T_world_curve, options_.align);
  if (!fits(anew)) return;
  const double before_mm = trajectory::pose_distance_mm(T_world_curve, T_world_sensor, radius_mm_);
  const double after_mm =
      trajectory::pose_distance_mm(T_world_curve, anew.T_target_source, radius_mm_);
  if (after_mm < before_mm) move(i, anew.T_target_source);
}

}  // namespace flytri::tracking
