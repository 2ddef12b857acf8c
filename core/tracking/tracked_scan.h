/// @file  Views registered in one world frame, and the search for the pose of the next view.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/editing/edits.h"
#include "core/registration/align.h"
#include "core/registration/overlap_grid.h"
#include "core/tracking/surface_hold.h"
#include "core/trajectory/hand_motion.h"
#include "core/trajectory/rolling_shutter.h"
#include "core/trajectory/trajectory.h"

namespace flytri::tracking {

/// Lengths are shares of the radius of a view, as in AlignOptions.
struct TrackOptions {
  registration::AlignOptions align;
  SmoothingOptions smoothing;
  /// Default 6, >= 1. Number of latest views in the single registration.
  int single_views = 6;
  /// Default 25, >= 1. Number of overlapping earlier views in the metaview, drawn at random by
  /// worth. It limits the time per view in long scans.
  int metaview_views = 25;
  /// Default 600, >= 20. AlignOptions::coarse_pairs of locate(): from an inaccurate start pose,
  /// most pairs do not cross, so more are needed.
  int locate_pairs = 600;
  /// Default 100, >= 6. Least number of points of a view: fewer do not determine a pose.
  int min_points = 100;
  /// Default 0.5, range (0, 5]. A view farther from its predicted pose than this share of the
  /// radius does not count as tracked, even if it fits.
  double max_surprise_share = 0.5;
  /// Default 0.03, range [0, 1). Where the surface leaves a direction open, the motion of the hand
  /// holds it, as long as the standard uncertainty of both together is at most this. 0: never.
  double max_held_share = 0.03;
  /// Default: a global one. Views of a rolling shutter are registered as a global one would have
  /// seen them, by the motion of the hand.
  trajectory::Shutter shutter = {};
  /// Default true. Check the path with RANSAC, as in the paper, section "Sensor Movement
  /// Reconstruction".
  bool check_path = true;

  [[nodiscard]] Result<void> validate() const;
};

/// A new view, and the same prepared.
struct IncomingView {
  std::shared_ptr<const View> view;
  registration::PreparedView prepared;  ///< sensor frame
  /// Of a rolling shutter, once `view` is corrected: as it was measured. Null: `view` is.
  std::shared_ptr<const View> measured = nullptr;
};

/// A registered view. `placed` is what serves of the prepared view, in the world frame.
struct TrackedView {
  AlignedView aligned;  ///< the whole view, as a global shutter would have seen it
  registration::PreparedView placed;
  /// Standard uncertainty of the pose in the worst of the six directions, when it was registered.
  /// NaN: not known. Infinite: the surface does not fix the pose.
  double uncertainty_mm = std::numeric_limits<double>::quiet_NaN();
  bool confirmed = false;  ///< off the path, but fits at its pose: not checked again
  /// Of a view that edits have cut: what serves of it, and what was placed before. So undo brings
  /// back the same bits.
  std::shared_ptr<const View> part = nullptr;
  std::optional<registration::PreparedView> placed_whole = std::nullopt;
  std::shared_ptr<const View> measured = nullptr;  ///< as IncomingView::measured

  [[nodiscard]] const std::shared_ptr<const View>& as_measured() const {
    return measured != nullptr ? measured : aligned.view;
  }
  /// What serves of it, see editing::serving_views().
  [[nodiscard]] AlignedView serving() const {
    return {part != nullptr ? part : aligned.view, aligned.T_world_sensor};
  }
};

/// Registered views that share a world frame, that of their first view.
class TrackedScan {
 public:
  TrackedScan(const TrackOptions& options, double radius_mm);

  [[nodiscard]] std::size_t size() const { return views_.size(); }
  [[nodiscard]] const std::vector<TrackedView>& views() const { return views_; }
  [[nodiscard]] const trajectory::Trajectory& trajectory() const { return trajectory_; }

  /// Pose of the view with this time.
  [[nodiscard]] std::optional<Isometry> registered_pose(double time_s) const;
  /// Changes the world frame of all poses to `new`.
  void change_frame(const Isometry& T_new_world);
  /// View i in its sensor frame.
  [[nodiscard]] IncomingView incoming(std::size_t i) const;

  /// Adds the view at this pose.
  /// @param uncertainty_mm  see TrackedView
  void add(IncomingView incoming, const Isometry& T_world_sensor,
           double uncertainty_mm = std::numeric_limits<double>::quiet_NaN());
  /// Adds the view at its aligned pose, and records how well it fits for usual_rms_mm().
  void add(IncomingView incoming, const registration::Alignment& alignment);
  /// Largest usual RMS distance of crossings in this scan; at a wrong pose it is several times
  /// larger. Infinite until enough views were aligned.
  [[nodiscard]] double usual_rms_mm() const;
  [[nodiscard]] SurfaceHold surface_hold() const;
  /// True if the view comes so soon after the last that its pose can be predicted.
  [[nodiscard]] bool continues(double time_s) const;
  /// From now on, only samples that these edits keep serve the registration. The edits are in the
  /// world frame of this scan.
  void set_edits(const editing::EditFilter& edits);
  /// Drops the points of a view. It keeps its pose, but no view is registered to it any more.
  void retire(std::size_t i);
  /// Corrects a view for a rolling shutter, by the motion that the path has at this pose.
  void correct(IncomingView& incoming, const Isometry& T_world_sensor) const;
  /// Corrects all views again, by their present poses and those before and after them.
  void correct_all();
  /// Changes the pose of view i.
  void move(std::size_t i, const Isometry& T_world_sensor);

  /// Finds the pose of the next view in time: starts at the predicted pose, registers to the latest
  /// views, then to the metaview. If this fails, tries the other guesses of the trajectory.
  /// @param incoming  corrected for a rolling shutter
  [[nodiscard]] registration::Alignment track(IncomingView& incoming) const;
  /// Finds a pose near a start pose, without a prediction. The start may be wrong by a sixth of the
  /// radius.
  [[nodiscard]] registration::Alignment locate(const IncomingView& incoming,
                                               const Isometry& T_world_start) const;
  /// How well view i fixes its pose: see TrackedView. If it is not known, it is worked out and
  /// kept.
  double uncertainty_mm(std::size_t i);
  /// Checks the latest part of the path: outliers are registered again, starting on the fitted
  /// curve. They keep their pose if no better one is found.
  void check_path();

  /// Views that overlap a view at this pose, drawn at random by worth.
  [[nodiscard]] std::vector<const registration::PreparedView*> metaview(
      const IncomingView& incoming, const Isometry& T_world_sensor, std::size_t skip_view) const;

 private:
  /// As track(), without a correction.
  [[nodiscard]] registration::Alignment track_as_it_is(const IncomingView& incoming) const;
  void correct_again(std::size_t i);
  [[nodiscard]] registration::Alignment track_corrected(IncomingView& incoming,
                                                        Isometry T_world_sensor) const;
  /// Poses at a later time if the hand moves on as before, the likeliest first.
  /// Trajectory::predict() may give the last pose again, from which no velocity follows.
  [[nodiscard]] std::vector<Isometry> moved_on(double time_s) const;
  /// `spread` times the median of the latest views that the surface placed, plus a share of the
  /// radius.
  [[nodiscard]] double usual_rms_mm(double spread, double least_share) const;
  /// Finds the pose of a view that the surface alone does not determine.
  [[nodiscard]] registration::Alignment hold(const IncomingView& incoming) const;
  /// One attempt of track().
  [[nodiscard]] registration::Alignment track_from(
      const IncomingView& incoming, const trajectory::PosePrediction& prediction) const;
  /// Registers view i again, starting on the path; uses the new pose only if it is nearer to the
  /// path.
  void reregister(std::size_t i, const Isometry& T_world_curve);
  void cut(TrackedView& view, const std::shared_ptr<const View>& serving) const;
  void locate_extent(std::size_t i);
  [[nodiscard]] std::vector<const registration::PreparedView*> latest_views() const;
  [[nodiscard]] registration::Alignment align(
      const IncomingView& incoming, const std::vector<const registration::PreparedView*>& metaview,
      const Isometry& T_world_guess, const registration::AlignOptions& options) const;

  TrackOptions options_;
  double radius_mm_;
  std::vector<TrackedView> views_;
  editing::EditFilter edits_{editing::EditStack().state()};
  registration::OverlapGrid grid_;
  trajectory::Trajectory trajectory_;
  trajectory::HandMotion motion_;
  Matrix6 latest_information_ = Matrix6::Zero();  ///< mean of the latest aligned views
  std::size_t averaged_views_ = 0;
  std::vector<double> rms_mm_;  ///< of the aligned views, in order
};

/// Value of `skip_view` that skips no view.
inline constexpr std::size_t kSkipNone = static_cast<std::size_t>(-1);

}  // namespace flytri::tracking
