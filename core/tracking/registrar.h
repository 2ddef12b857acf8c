/// @file  Keeps the poses of a scan: takes views one by one, says what became of each, and finds
/// back after the object was lost.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/tracking/entry_starts.h"
#include "core/tracking/reentry_proposal.h"

namespace flytri::tracking {

/// What became of a view.
enum class ViewFate {
  kRegistered,    ///< aligned to others by its own profiles
  kInterpolated,  ///< skipped by option; its pose lies on the path between its neighbors
  kRejected       ///< without a pose
};

/// Why a view has no pose.
enum class RejectReason {
  kNone,
  kTooFewPoints,     ///< nothing, or nearly nothing, of the object was in the volume
  kTooFewCrossings,  ///< no overlap with earlier views
  kUndetermined,     ///< the surface does not fix the pose
  kPoorFit,  ///< its profiles contradict the model: motion blur, wrong pattern, other object
  kNotConverged,
  kTimeNotRising,  ///< its time does not come after that of the view before
  kNotConnected    ///< it fits other views, but these never met the rest of the scan
};

[[nodiscard]] std::string_view to_string(ViewFate fate);
[[nodiscard]] std::string_view to_string(RejectReason reason);

/// A view and its fate. The pose is valid unless rejected.
struct RegisteredView {
  std::shared_ptr<const View> view;
  ViewFate fate = ViewFate::kRejected;
  RejectReason reason = RejectReason::kNone;
  Isometry T_world_sensor = Isometry::Identity();
  double rms_mm = 0.0;  ///< of the crossings, where add() registered it to others; else 0
};

/// How the scan grew since it was last asked.
struct ScanGrowth {
  /// The scan is another submap now, or all poses have changed: `added` is all of it.
  bool is_all = false;
  std::vector<AlignedView> added;
};

struct RegistrarOptions {
  TrackOptions track;
  /// Default 20, range [1, 1000]. k of the paper: views tried against the last good one before the
  /// scan counts as interrupted.
  int patience_views = 20;
  /// Default 30, range [1, 1000]. l of the paper: latest pairs of which the best is proposed.
  int proposal_pairs = 30;
  /// Default 6, range [1, 1000]. Start poses tried for each view while lost: bounds its time.
  int starts_per_view = 6;
  /// Default 1500, range [1, 100000]. Start poses tried at most for a view after the scan.
  int retry_starts = 1500;
  /// Default 14, range [0, 1000]. Evidence, see judge(), that a lost view needs to enter: a million
  /// to one, because so many places are tried.
  double min_entry_evidence = 14.0;
  /// Default 100, range [1, 1000000]. A scan of so many views stays the scan while it goes on,
  /// however large another submap grows: what was edited and measured refers to its frame. Before,
  /// the larger submap takes its place: the first views may have been useless.
  int settled_views = 100;
  /// Default 1, >= 1. Only every n-th view of each pattern is registered, the others are
  /// interpolated.
  int register_every = 1;
  /// Default 0.5, > 0. Longest gap in time over which poses are interpolated, s.
  double max_gap_s = 0.5;

  [[nodiscard]] Result<void> validate() const;
};

/// While lost, views go on registering among themselves as a submap with a frame of its own; the
/// submap joins the scan when two of its views agree on where. So nothing seen meanwhile is lost,
/// and a scan whose first views are useless goes on from its first good one.
class Registrar {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<Registrar> create(const RegistrarOptions& options = {});

  /// Takes the next view. The fate is the present one: submaps that join later
  /// and skipped views are settled by finish().
  RegisteredView add(const std::shared_ptr<const View>& view);
  /// Takes the next view where there is no time to register it: its pose is interpolated.
  RegisteredView skip(const std::shared_ptr<const View>& view);

  /// Takes views at known poses, before any other: a scan that goes on.
  /// @param views  by rising time, in one world frame
  void restore(std::span<const AlignedView> views);

  /// True after more than `patience_views` failures in a row: continuation mode.
  [[nodiscard]] bool interrupted() const { return lost_views_ > options_.patience_views; }
  /// The best of the latest pairs. None before two views are registered.
  [[nodiscard]] std::optional<ReentryProposal> proposal() const;
  /// That one, then others all over the scan, apart from each other, by falling rating.
  [[nodiscard]] std::vector<ReentryProposal> proposals(std::size_t count) const;
  /// Where the operator was asked to enter, if it is not the first proposal: searched first.
  void expect_entry_at(const std::optional<Isometry>& T_world_sensor) {
    asked_entry_ = T_world_sensor;
  }
  /// 0..1: how near the latest lost views came to entering the scan: what spoke for the best pose
  /// that was tried, see Agreement::proof, by what a view needs to enter. 1 if it is not lost.
  [[nodiscard]] double entry_share() const { return lost_views_ == 0 ? 1.0 : entry_share_; }

  /// Views registered so far in the world frame of the largest submap, but for those retired.
  [[nodiscard]] std::vector<AlignedView> aligned_views() const;
  /// What came to the scan since the last call, submaps that joined included.
  [[nodiscard]] ScanGrowth take_growth();
  /// Lets go of the points of views, told by their times, where so many others have seen the same:
  /// they stay registered, but are no longer among aligned_views(). For views that are past.
  void retire(std::span<const double> times_s);
  /// Gives views the poses that an optimization of the whole scan has found. Views that came after
  /// it began are carried along with the last that it knew.
  void apply(std::span<const AlignedView> refined);
  /// Path of the sensor through the largest submap.
  [[nodiscard]] const trajectory::Trajectory& trajectory() const {
    return submaps_[scan_]->trajectory();
  }

  /// After the scan: tries submaps and rejected views once more against the whole model, then
  /// settles every fate, in the order of add(). The world becomes the sensor frame of the first
  /// view, unless it is to stay: edits and measurements refer to it.
  /// @param progress  advances by one step at most; canceled, what was not tried again stays what
  /// it was
  enum class World { kFirstView, kUnchanged };
  [[nodiscard]] std::vector<RegisteredView> finish(World world = World::kFirstView,
                                                   const Progress& progress = {});

 private:
  explicit Registrar(const RegistrarOptions& options) : options_(options) {}

  struct Added {
    std::shared_ptr<const View> view;
    RejectReason reason = RejectReason::kNone;
    bool skipped = false;
  };
  /// A pose that one view of a submap suggests for itself and its submap.
  struct Claim {
    std::size_t submap = 0;
    Isometry T_scan_submap = Isometry::Identity();
    Isometry T_scan_sensor = Isometry::Identity();
  };

  RegisteredView take(const std::shared_ptr<const View>& view, bool may_register);
  RejectReason register_view(IncomingView incoming);
  RejectReason track_lost(IncomingView incoming, RejectReason reason, bool search);
  bool try_to_join(std::size_t submap, std::size_t i, bool all_starts);
  bool confirm_claim(std::size_t submap, const IncomingView& incoming,
                     const Isometry& T_submap_sensor);
  void join(std::size_t submap, const Isometry& T_scan_submap);
  void start_submap(IncomingView incoming);
  [[nodiscard]] EntryStarts entry_starts();
  [[nodiscard]] bool convincing(const registration::Alignment& alignment) const;
  void show_nearness(double proof);
  void retry_submaps(const Progress& progress);
  void retry_submap(std::size_t submap);
  void choose_largest_piece(const Progress& progress);
  void retry_rejected(const Progress& progress);
  void retry_rejected(const Added& added);
  [[nodiscard]] RegisteredView settle(const Added& added) const;

  RegistrarOptions options_;
  std::vector<Added> added_;
  std::vector<std::unique_ptr<TrackedScan>> submaps_;
  std::size_t scan_ = 0;  ///< the submap that is the scan
  std::size_t side_ = 0;  ///< the submap that lost views go to; scan_ if there is none
  int lost_views_ = 0;
  double last_time_s_ = -std::numeric_limits<double>::infinity();
  std::array<int, 2> pattern_counts_{};  ///< views added so far, by Pattern
  double radius_mm_ = 0.0;
  std::optional<Claim> claim_;
  std::optional<Isometry> asked_entry_;
  /// path_stops() of the scan, for as long as it is the same: many lost views ask for them.
  struct KnownStops {
    std::size_t submap = 0, views = 0;
    std::vector<Isometry> poses;
  };
  KnownStops stops_;
  double entry_share_ = 0.0;
  double latest_rms_mm_ = 0.0;                    ///< of the view that was registered last
  std::size_t told_submap_ = 0, told_views_ = 0;  ///< what take_growth() has told
};

}  // namespace flytri::tracking
