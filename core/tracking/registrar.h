/// @file  Registers the views of a scan one by one, reports the fate of each, and resumes after
///          tracking was lost.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/tracking/entry_search.h"
#include "core/tracking/lost_sensor.h"
#include "core/tracking/reentry_proposal.h"

namespace flytri::tracking {

/// Fate of a view.
enum class ViewFate {
  kRegistered,    ///< aligned to others by its own profiles
  kInterpolated,  ///< skipped; its pose is interpolated between its neighbors in time
  kRejected       ///< without a pose
};

/// Why a view has no pose.
enum class RejectReason {
  kNone,
  kTooFewPoints,     ///< nothing or almost nothing of the object was in the measurement volume
  kTooFewCrossings,  ///< no overlap with earlier views
  kUndetermined,     ///< the surface does not determine the pose
  kPoorFit,  ///< its profiles do not fit the model: motion blur, wrong pattern, other object
  kNotConverged,
  kTimeNotRising,  ///< its time is not later than that of the previous view
  kNotConnected    ///< it fits other views, but these were never connected to the rest of the scan
};

[[nodiscard]] std::string_view to_string(ViewFate fate);
[[nodiscard]] std::string_view to_string(RejectReason reason);

/// A view and its fate. The pose is valid unless rejected.
struct RegisteredView {
  std::shared_ptr<const View> view;
  ViewFate fate = ViewFate::kRejected;
  RejectReason reason = RejectReason::kNone;
  Isometry T_world_sensor = Isometry::Identity();
  double rms_mm = 0.0;  ///< RMS distance at the crossings if add() registered it to other views,
                        ///< else 0
};

/// Views added to the scan since the last call.
struct ScanGrowth {
  /// True if another submap became the scan, or all poses have changed: `added` has all views.
  bool is_all = false;
  std::vector<AlignedView> added;
  std::vector<std::shared_ptr<const View>> measured;  ///< the same views as they were measured
};

struct RegistrarOptions {
  TrackOptions track;
  /// Default 20, range [1, 1000]. k of the paper (section "Preview and Continuation Mode"): failed
  /// views in a row before the scan counts as interrupted.
  int patience_views = 20;
  /// Default 30, range [1, 1000]. l of the paper: number of latest view pairs of which the best is
  /// proposed.
  int proposal_pairs = 30;
  /// Default 4, range [1, 1000]. While tracking is lost, the whole scan is searched with every n-th
  /// view: a search takes as long as several frames.
  int search_every = 4;
  /// Default 8, range [1, 1000]. Best places of a search at which a lost view is registered.
  int searched_places = 8;
  /// Default 24, range [1, 1000]. The same for a view after the scan.
  int retried_places = 24;
  /// Default 14, range [0, 1000]. Evidence, see judge(), that a lost view needs to resume the scan:
  /// odds of a million to one, because many places are tried.
  double min_entry_evidence = 14.0;
  /// Default 100, range [1, 1000000]. With this many views, the scan is kept even if another submap
  /// grows larger: edits and measurements refer to its frame. With fewer views, a larger submap
  /// replaces it, because the first views may have been useless.
  int settled_views = 100;
  /// Default 1, >= 1. Only every n-th view of each pattern is registered; the poses of the others
  /// are interpolated.
  int register_every = 1;
  /// Default 0.5, > 0. Longest gap in time over which poses are interpolated, s.
  double max_gap_s = 0.5;

  [[nodiscard]] Result<void> validate() const;
};

/// While tracking is lost, views are registered to each other in a submap with its own frame. The
/// submap joins the scan when two of its views agree on the pose. So no data is lost meanwhile, and
/// a scan with useless first views starts at its first good view.
class Registrar {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<Registrar> create(const RegistrarOptions& options = {});

  /// Takes the next view and returns its fate so far. finish() decides about skipped views and
  /// about submaps that join later.
  RegisteredView add(const std::shared_ptr<const View>& view);
  /// Takes the next view without registering it, for lack of time: its pose is interpolated.
  RegisteredView skip(const std::shared_ptr<const View>& view);

  /// Continues a saved scan: takes views with known poses. Call it before add().
  /// @param views  by rising time, in one world frame
  void restore(std::span<const AlignedView> views);

  /// True after more than `patience_views` failures in a row: continuation mode.
  [[nodiscard]] bool interrupted() const { return lost_views_ > options_.patience_views; }
  /// The best of the latest view pairs; nullopt before two views are registered.
  [[nodiscard]] std::optional<ReentryProposal> proposal() const;
  /// That proposal, then others along the whole scan, apart from each other, by falling rating.
  [[nodiscard]] std::vector<ReentryProposal> proposals(std::size_t count) const;
  /// Where the user was asked to resume, if this is not the first proposal. It is searched first.
  void expect_entry_at(const std::optional<Isometry>& T_world_sensor) {
    asked_entry_ = T_world_sensor;
  }
  /// 0..1: how close the latest lost views came to resuming the scan: the proof (see
  /// Agreement::proof) for the best tried pose, divided by the evidence that a view needs. 1 if
  /// tracking is not lost.
  [[nodiscard]] double entry_share() const { return lost_views_ == 0 ? 1.0 : entry_share_; }

  [[nodiscard]] SurfaceHold surface_hold() const {
    return submaps_.empty() || interrupted() ? SurfaceHold{} : submaps_[scan_]->surface_hold();
  }

  /// Empty if tracking is not lost.
  [[nodiscard]] const LostSensor& lost_sensor() const { return lost_sensor_; }

  /// From now on, views are registered only to samples that these edits keep. Takes time for each
  /// view that an edit cuts. The edits are in the world frame of the scan: no other submap becomes
  /// the scan any more.
  void set_edits(const editing::EditList& edits);

  /// The views registered so far, in the world frame of the scan, without retired ones.
  [[nodiscard]] std::vector<AlignedView> aligned_views() const;
  /// The same with the points as measured, where a rolling shutter was corrected.
  [[nodiscard]] std::vector<AlignedView> measured_views() const;
  /// Of the aligned views, what the edits keep, see editing::serving_views(). A view of which
  /// nothing is kept is left out.
  [[nodiscard]] std::vector<AlignedView> serving_views() const;
  /// Views added to the scan since the last call, including joined submaps.
  [[nodiscard]] ScanGrowth take_growth();
  /// Drops the points of views, given by their times, to save memory where many others have seen
  /// the same surface. The views stay registered, but are no longer in aligned_views().
  void retire(std::span<const double> times_s);
  /// Applies the poses of a global optimization. Views that it did not contain move together with
  /// the last earlier view that it contained.
  void apply(std::span<const AlignedView> refined);
  /// Path of the sensor through the scan.
  [[nodiscard]] const trajectory::Trajectory& trajectory() const {
    return submaps_[scan_]->trajectory();
  }

  /// Changes the world frame of the scan to `new`. The next growth has all views.
  void change_frame(const Isometry& T_new_world);
  [[nodiscard]] const RegistrarOptions& options() const { return options_; }

  /// The world frame of the finished scan.
  enum class World {
    kFirstView,  ///< the sensor frame of the first view
    kUnchanged   ///< as before: edits and measurements refer to it
  };
  /// After the scan: tries submaps and rejected views again with the whole model, then returns the
  /// final fate of every view, in the order of add().
  /// @param progress  advances by at most one step. After a cancellation, views that were not tried
  ///                  again keep their fate
  [[nodiscard]] std::vector<RegisteredView> finish(World world = World::kFirstView,
                                                   const Progress& progress = {});

 private:
  explicit Registrar(const RegistrarOptions& options) : options_(options) {}

  struct Added {
    std::shared_ptr<const View> view;
    RejectReason reason = RejectReason::kNone;
    bool skipped = false;
  };
  /// A pose that one view found for itself and its submap, not yet confirmed by another view.
  struct Claim {
    std::size_t submap = 0;
    Isometry T_scan_submap = Isometry::Identity();
    Isometry T_scan_sensor = Isometry::Identity();
  };

  /// The views of the scan in this form, by rising time; those without points are left out.
  template <typename Form>
  [[nodiscard]] std::vector<AlignedView> views_with_points(const Form& form) const;
  RegisteredView take(const std::shared_ptr<const View>& view, bool may_register);
  RejectReason register_view(IncomingView incoming);
  RejectReason track_lost(IncomingView incoming, RejectReason reason, bool search);
  /// @param searched_places  best places of a search to try after the likely ones; 0: no search
  bool try_to_join(std::size_t submap, std::size_t i, int searched_places);
  bool is_search_due();
  bool confirm_claim(std::size_t submap, const IncomingView& incoming,
                     const Isometry& T_submap_sensor);
  void join(std::size_t submap, const Isometry& T_scan_submap);
  void start_submap(IncomingView incoming);
  [[nodiscard]] EntrySearch::Hints entry_hints() const;
  [[nodiscard]] bool convincing(const registration::Alignment& alignment) const;
  void tell_of_search(const registration::Alignment& best);
  void retry_submaps(const Progress& progress);
  void retry_submap(std::size_t submap);
  void choose_largest_submap(const Progress& progress);
  void retry_rejected(const Progress& progress);
  void retry_rejected(const Added& added);
  [[nodiscard]] RegisteredView final_fate(const Added& added) const;

  RegistrarOptions options_;
  std::vector<Added> added_;
  std::vector<std::unique_ptr<TrackedScan>> submaps_;
  std::size_t scan_ = 0;  ///< the submap that is the scan
  std::size_t side_ = 0;  ///< the submap for lost views; scan_ if there is none
  int lost_views_ = 0;
  double last_time_s_ = -std::numeric_limits<double>::infinity();
  std::array<int, 2> pattern_counts_{};  ///< views added so far, by Pattern
  double radius_mm_ = 0.0;
  editing::EditList edits_ = editing::EditStack().state();
  std::optional<Claim> claim_;
  std::optional<Isometry> asked_entry_;
  EntrySearch entry_search_;
  int unsearched_views_ = 0;  ///< lost views since the last search
  double entry_share_ = 0.0;
  LostSensor lost_sensor_;
  double latest_rms_mm_ = 0.0;       ///< of the latest registered view
  std::size_t returned_submap_ = 0;  ///< the scan at the last call of take_growth()
  std::size_t returned_views_ = 0;   ///< its views that take_growth() has already returned
};

}  // namespace flytri::tracking
