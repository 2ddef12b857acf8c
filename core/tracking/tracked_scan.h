/// @file  Views registered one after the other in one world frame, and the search for the pose of
/// the next.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/registration/align.h"
#include "core/registration/overlap_grid.h"
#include "core/trajectory/trajectory.h"

namespace flytri::tracking {

/// How views are tracked. Shares are of the radius of a view, as in AlignOptions.
struct TrackOptions {
  registration::AlignOptions align;
  SmoothingOptions smoothing;
  /// Default 6, >= 1. Latest views that the single registration uses.
  int single_views = 6;
  /// Default 25, >= 1. Overlapping earlier views that make up the metaview, drawn by worth: it
  /// bounds the time of a view however long the scan is.
  int metaview_views = 25;
  /// Default 600, >= 20. AlignOptions::coarse_pairs where the start is a guess: there most pairs do
  /// not cross, and those that do have to lead the way.
  int locate_pairs = 600;
  /// Default 100, >= 6. Points that a view must have: fewer carry no pose.
  int min_points = 100;
  /// Default 0.5, range (0, 5]. Farther from its prediction than this share of the radius a view is
  /// not taken for tracked, even if it fits.
  double max_surprise_share = 0.5;
  /// Default true. The paper's check of the path by RANSAC.
  bool check_path = true;

  [[nodiscard]] Result<void> validate() const;
};

/// A view as it came, and made ready.
struct IncomingView {
  std::shared_ptr<const View> view;
  registration::PreparedView prepared;  ///< sensor frame
};

/// A registered view. `placed` is the prepared view in the world frame.
struct TrackedView {
  AlignedView aligned;
  registration::PreparedView placed;
  bool confirmed = false;  ///< found off the path, and yet it fits where it is: not asked again
};

/// Registered views that share a world frame, that of their first view.
class TrackedScan {
 public:
  TrackedScan(const TrackOptions& options, double radius_mm);

  [[nodiscard]] std::size_t size() const { return views_.size(); }
  [[nodiscard]] const std::vector<TrackedView>& views() const { return views_; }
  [[nodiscard]] const trajectory::Trajectory& trajectory() const { return trajectory_; }

  /// Pose of the kept view of this time.
  [[nodiscard]] std::optional<Isometry> registered_pose(double time_s) const;
  /// Expresses all poses in world frame `new`.
  void change_frame(const Isometry& T_new_world);
  /// A kept view as it came.
  [[nodiscard]] IncomingView incoming(std::size_t i) const;

  /// Keeps the view at this pose.
  void add(IncomingView incoming, const Isometry& T_world_sensor);
  /// Keeps the view where it was aligned, and learns from it how well views fit here.
  void add(IncomingView incoming, const registration::Alignment& alignment);
  /// Largest RMS distance of crossings that is usual in this scan: at a wrong place views fit
  /// several times worse. Infinite before there is experience.
  [[nodiscard]] double usual_rms_mm() const;
  /// True if the view comes so soon after the last that its pose can be predicted.
  [[nodiscard]] bool continues(double time_s) const;
  /// Lets go of what a view measured: it keeps its pose, and nothing is registered to it any more.
  void retire(std::size_t i);
  /// Gives a kept view another pose.
  void move(std::size_t i, const Isometry& T_world_sensor);

  /// Pose of the next view in time: predicted, registered to the latest views, then to the
  /// metaview; if that fails, from the other guesses of the trajectory.
  [[nodiscard]] registration::Alignment track(const IncomingView& incoming) const;
  /// Pose near a start, by the overlapping views alone: the start may be off by a sixth of the
  /// radius.
  [[nodiscard]] registration::Alignment locate(const IncomingView& incoming,
                                               const Isometry& T_world_start) const;
  /// Checks the latest stretch of the path: outliers are put back onto the curve and registered
  /// again from there. They keep their pose if that finds nothing better.
  void check_path();

  /// Views to align to around a pose: the last of `latest_count`, the rest by worth.
  [[nodiscard]] std::vector<const registration::PreparedView*> metaview(
      const IncomingView& incoming, const Isometry& T_world_sensor, std::size_t skip_view) const;

 private:
  /// One try of track().
  [[nodiscard]] registration::Alignment track_from(
      const IncomingView& incoming, const trajectory::PosePrediction& prediction) const;
  /// Aligns view i again from a place on the path; keeps it where it is unless that is nearer.
  void reregister(std::size_t i, const Isometry& T_world_curve);
  [[nodiscard]] std::vector<const registration::PreparedView*> latest_views() const;
  [[nodiscard]] registration::Alignment align(
      const IncomingView& incoming, const std::vector<const registration::PreparedView*>& metaview,
      const Isometry& T_world_guess, const registration::AlignOptions& options) const;

  TrackOptions options_;
  double radius_mm_;
  std::vector<TrackedView> views_;
  registration::OverlapGrid grid_;
  trajectory::Trajectory trajectory_;
  std::vector<double> rms_mm_;  ///< of the views that were aligned, as they came
};

/// No view is left out of a metaview.
inline constexpr std::size_t kSkipNone = static_cast<std::size_t>(-1);

}  // namespace flytri::tracking
