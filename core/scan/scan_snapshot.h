/// @file  The immutable state of a live scan at one moment: everything that the window shows of it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/verify/pattern_shift.h"
#include "core/editing/edits.h"
#include "core/geometry/jaw_axes.h"
#include "core/geometry/surfel.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"
#include "core/meshing/surface_mesh.h"
#include "core/reconstruct/finish_scan.h"
#include "core/scan/scan_state.h"
#include "core/tracking/lost_sensor.h"
#include "core/tracking/surface_hold.h"

namespace flytri::scan {

/// Each offered frame is counted here exactly once.
struct FrameCounts {
  std::int64_t offered = 0;
  std::int64_t previewed = 0;                    ///< measured while the scan was paused
  std::int64_t registered = 0;                   ///< aligned by their own profiles
  std::int64_t interpolated = 0;                 ///< measured; the pose lies between its neighbors
  std::int64_t textured = 0;                     ///< texture frames
  std::int64_t skipped = 0;                      ///< not measured, as the program was too busy
  std::int64_t pending = 0;                      ///< not processed yet
  std::map<std::string, std::int64_t> rejected;  ///< by reason, in the user's words

  [[nodiscard]] std::int64_t rejected_count() const;
};

/// A frame, and what was found in it.
struct LiveFrame {
  Frame frame;
  std::vector<std::vector<Pixel>> lines;  ///< the localized lines of a measurement frame
  std::shared_ptr<const View> view;       ///< null: nothing was measured
};

/// A place where a lost scan can be continued: two successive views.
struct ReentryPlace {
  AlignedView first, second;
  double uncertainty_mm = 0.0;             ///< the rating, see tracking::ReentryProposal
  std::shared_ptr<const LiveFrame> image;  ///< what the sensor saw there; may be null
};

/// Where the sensor is relative to the surface, from the latest measured views.
struct SensorDistance {
  /// Mean depth of the points by half the depth of the volume: -1 at the near end of the volume, 0
  /// in the middle, 1 at the far end.
  double depth_share = 0.0;
  /// Number of points, relative to a well-placed view of this scan: 0..1.
  double filled_share = 0.0;
};

/// Progress of the finishing.
struct FinishingState {
  std::string stage;          ///< for the user; empty: not begun
  double fraction = 0.0;      ///< of all stages together: 0..1
  double remaining_s = -1.0;  ///< of all stages; negative: not known yet
};

/// Time from the arrival of a frame to the published model that shows it, s.
struct LatencyStatistics {
  double median_s = 0.0;
  double percentile_95_s = 0.0;
  std::int64_t count = 0;  ///< of the latest frames
};

struct ScanSnapshot {
  std::uint64_t number = 0;  ///< larger than that of the snapshot before
  ScanPhase phase = ScanPhase::kPreview;
  double time_s = 0.0;              ///< of the latest frame
  double scanned_s = 0.0;           ///< time in the phases measurement and continuation
  FrameCounts counts;               ///< since the scan was opened
  std::int64_t restored_views = 0;  ///< registered before that

  /// Views that are part of the scan.
  [[nodiscard]] std::int64_t view_count() const {
    return restored_views + counts.registered + counts.interpolated;
  }
  LatencyStatistics latency;
  /// When the newest frame that the model shows was offered, in the clock of the scan.
  double model_offered_at_s = 0.0;

  std::array<std::shared_ptr<const LiveFrame>, 2> latest;  ///< measurement frames, by Pattern
  std::shared_ptr<const LiveFrame> latest_texture;
  std::optional<SensorDistance> distance;
  std::optional<double> residual_mm;       ///< RMS at the crossings of the latest registration
  std::optional<Isometry> T_world_sensor;  ///< of the latest registered view
  /// A projector has probably moved since the calibration. Stays until the scan is opened anew.
  std::optional<calibration::PatternShift> moved_projector;

  SurfelModel model;
  double good_share = 0.0;  ///< share of well-covered surfels: 0..1
  double area_mm2 = 0.0;    ///< of the surface seen so far
  /// Number of surfels of what has gone from the view, and whether the model shows them, see
  /// live::LiveSurface.
  std::size_t crossed_count = 0;
  bool shows_crossed = false;
  std::vector<meshing::BoundaryLoop> holes;  ///< see coverage_holes(); empty until searched
  bool holes_are_current = false;            ///< the surface has not changed since the search
  /// How the jaw lay at the latest search for holes; none of a face.
  std::optional<JawAxes> jaw;

  std::vector<ReentryPlace> reentry;  ///< best first; empty unless in continuation
  std::size_t chosen_reentry = 0;
  /// 0..1: how close the latest views came to being registered, see Registrar::entry_share(). 0 if
  /// the sensor sees nothing.
  double match_share = 0.0;
  tracking::LostSensor lost_sensor;    ///< in continuation
  tracking::SurfaceHold surface_hold;  ///< in measurement

  editing::EditList edits;
  bool can_undo = false, can_redo = false;

  FinishingState finishing;                                 ///< in kFinishing
  std::shared_ptr<const reconstruct::FinishedScan> result;  ///< in kFinished
  std::string failure;                                      ///< why there is no result
};

}  // namespace flytri::scan
