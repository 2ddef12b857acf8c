/// @file  A live scan of simulated views, frame by frame, compared with the true poses of the
/// sensor.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/lab/simulated_scan.h"
#include "core/scan/live_scan.h"

namespace flytri::lab {

/// The view and the true pose of one frame; no view while the sensor is in the air.
struct Exposure {
  std::shared_ptr<const View> view;
  Isometry T_model_sensor = Isometry::Identity();
  /// Number of the view among those that all compared trials see.
  std::optional<std::size_t> common;
};

/// A registered view with its true pose.
struct PlacedExposure {
  AlignedView placed;
  Isometry T_model_sensor = Isometry::Identity();
  std::optional<std::size_t> common;
};

/// The result of a trial.
struct TrialResult {
  scan::FrameCounts counts;
  std::vector<PlacedExposure> views;  ///< in order of time, after the final optimization
  int falsely_placed = 0;             ///< of these; see is_false_place()
};

/// Whether a pose is wrong by more than a correct registration ever is: 1 mm or 2 degrees.
/// @param T_model_world  pose of the world frame of the scan
[[nodiscard]] bool is_false_place(const Isometry& T_model_world, const Isometry& T_world_sensor,
                                  const Isometry& T_model_sensor);

/// One live scan. Waits for each frame, as the next place may depend on its fate.
class LiveTrial {
 public:
  /// @errors  as LiveScan::create.
  [[nodiscard]] static Result<std::unique_ptr<LiveTrial>> create();

  void expose(const Exposure& exposure);
  /// Frames in which the sensor sees nothing.
  void expose_nothing(int frames);
  [[nodiscard]] std::shared_ptr<const scan::ScanSnapshot> now() const { return scan_->snapshot(); }
  [[nodiscard]] const std::vector<Exposure>& exposures() const { return exposures_; }
  /// Views with a wrong pose while scanning, relative to the first view.
  [[nodiscard]] int falsely_registered() const { return falsely_registered_; }
  /// Optimizes all poses together.
  /// @errors  kInsufficient: nothing was scanned.
  [[nodiscard]] Result<TrialResult> finish();

 private:
  LiveTrial() = default;
  [[nodiscard]] Result<measurement::MeasuredView> measured(const Frame& frame) const;

  std::vector<Exposure> exposures_;  ///< by frame
  std::optional<Isometry> T_model_world_;
  int falsely_registered_ = 0;
  std::unique_ptr<scan::LiveScan> scan_;
};

}  // namespace flytri::lab
