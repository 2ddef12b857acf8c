/// @file  What a live scan is at one moment, immutable: everything that a window shows of it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/editing/edits.h"
#include "core/geometry/surfel.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"
#include "core/meshing/surface_mesh.h"
#include "core/reconstruct/finish_scan.h"
#include "core/scan/scan_state.h"

namespace flytri::scan {

/// Every frame that was offered is counted here exactly once.
struct FrameCounts {
  std::int64_t offered = 0;
  std::int64_t previewed = 0;     ///< measured while nothing was to be registered
  std::int64_t registered = 0;    ///< aligned by their own profiles
  std::int64_t interpolated = 0;  ///< measured; the pose lies between its neighbors'
  std::int64_t textured = 0;      ///< texture frames
  std::int64_t skipped = 0;       ///< lost to load: not measured, as later frames were waiting
  std::int64_t pending = 0;       ///< still on their way
  std::map<std::string, std::int64_t> rejected;  ///< by reason, in the user's words

  [[nodiscard]] std::int64_t rejected_count() const;
};

/// A frame as the sensor saw it, with what was found in it.
struct LiveFrame {
  Frame frame;
  std::vector<std::vector<Pixel>> lines;  ///< of measurement frames: what was localized
  std::shared_ptr<const View> view;       ///< null where nothing was measured
};

/// Where a lost scan may be taken up again: two views that were taken one after the other.
struct ReentryPlace {
  AlignedView first, second;
  std::size_t point_count = 0;             ///< the rating: sum over both
  std::shared_ptr<const LiveFrame> image;  ///< what the sensor saw there; null where not kept
};

/// Where the sensor is in front of the surface, from the latest measured views.
struct SensorDistance {
  /// Mean depth of the points by half the depth of the volume: -1 as near as it can measure, 0 in
  /// the middle, 1 as far.
  double depth_share = 0.0;
  /// Points by what a well-placed view of this scan has: 0..1.
  double filled_share = 0.0;
};

/// How far a step of the finishing is.
struct FinishingState {
  Progress::Snapshot step;
  double remaining_s = -1.0;  ///< of this step; negative: not known yet
};

/// How long frames take from the sensor to the model that is published, s.
struct LatencyStatistics {
  double median_s = 0.0;
  double percentile_95_s = 0.0;
  std::int64_t count = 0;  ///< of the latest frames
};

struct ScanSnapshot {
  std::uint64_t number = 0;  ///< rises from snapshot to snapshot
  ScanPhase phase = ScanPhase::kPreview;
  double time_s = 0.0;     ///< of the latest frame
  double scanned_s = 0.0;  ///< time spent in measurement and continuation
  FrameCounts counts;
  LatencyStatistics latency;
  /// When the newest frame that the model shows was offered, in the clock of the scan.
  double model_offered_at_s = 0.0;

  std::array<std::shared_ptr<const LiveFrame>, 2> latest;  ///< measurement frames, by Pattern
  std::shared_ptr<const LiveFrame> latest_texture;
  std::optional<SensorDistance> distance;
  std::optional<double> residual_mm;       ///< RMS of the latest registration's crossings
  std::optional<Isometry> T_world_sensor;  ///< of the latest registered view

  SurfelModel model;
  double good_share = 0.0;                   ///< of the surfels, covered well: 0..1
  double area_mm2 = 0.0;                     ///< of the surface seen so far
  std::vector<meshing::BoundaryLoop> holes;  ///< see coverage_holes(); empty until looked for
  bool holes_are_current = false;  ///< the surface has not grown since they were looked for

  std::vector<ReentryPlace> reentry;  ///< the best first; empty unless in continuation
  std::size_t chosen_reentry = 0;
  /// 0..1: how near the latest views came to be registered, see Registrar::entry_share(); 0 where
  /// the sensor sees nothing.
  double match_share = 0.0;

  editing::EditList edits;
  bool can_undo = false, can_redo = false;

  FinishingState finishing;                                 ///< in kFinishing
  std::shared_ptr<const reconstruct::FinishedScan> result;  ///< in kFinished
  std::string failure;  ///< why the finishing ended without a result
};

}  // namespace flytri::scan
