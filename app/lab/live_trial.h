/// @file  A live scan of simulated views, exposure by exposure, held against where the sensor truly
/// was.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/lab/simulated_scan.h"
#include "core/scan/live_scan.h"

namespace flytri::lab {

/// What the sensor sees in one frame, and where it is; no view while it is in the air.
struct Exposure {
  std::shared_ptr<const View> view;
  Isometry T_model_sensor = Isometry::Identity();
  /// Number of the view among those that every trial of a comparison gets to see.
  std::optional<std::size_t> common;
};

/// A view that was placed, and its exposure.
struct PlacedExposure {
  AlignedView placed;
  Isometry T_model_sensor = Isometry::Identity();
  std::optional<std::size_t> common;
};

/// What is left of a trial.
struct TrialResult {
  scan::FrameCounts counts;
  std::vector<PlacedExposure> views;  ///< by rising time, after the optimization of the whole scan
  int falsely_placed = 0;             ///< of these; see is_false_place()
};

/// True if a view is farther off than no error of a right registration ever is: 1 mm or 2 degrees.
/// @param T_model_world  where the scan has its world
[[nodiscard]] bool is_false_place(const Isometry& T_model_world, const Isometry& T_world_sensor,
                                  const Isometry& T_model_sensor);

/// One live scan. Waits for each frame: where the sensor goes next may depend on what became of it.
class LiveTrial {
 public:
  /// @errors  as LiveScan::create.
  [[nodiscard]] static Result<std::unique_ptr<LiveTrial>> create();

  void expose(const Exposure& exposure);
  /// Nothing before the sensor.
  void expose_nothing(int frames);
  [[nodiscard]] std::shared_ptr<const scan::ScanSnapshot> now() const { return scan_->snapshot(); }
  [[nodiscard]] const std::vector<Exposure>& exposures() const { return exposures_; }
  /// Views that were placed falsely as they came, told from the first view's pose.
  [[nodiscard]] int falsely_registered() const { return falsely_registered_; }
  /// Optimizes all together.
  /// @errors  kInsufficient: there is no scan to finish.
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
