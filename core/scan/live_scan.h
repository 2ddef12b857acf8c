/// @file  A scan while it happens: frames and the user's requests go in, immutable snapshots come
/// out.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/calibration/record/calibration.h"
#include "core/editing/edits.h"
#include "core/live/live_surface.h"
#include "core/measurement/measure_view.h"
#include "core/reconstruct/finish_scan.h"
#include "core/scan/scan_journal.h"
#include "core/scan/scan_snapshot.h"
#include "core/tracking/registrar.h"

namespace flytri::scan {

struct LiveScanOptions {
  measurement::MeasureOptions measure;
  tracking::RegistrarOptions registration;
  live::LiveSurfaceOptions surface;
  reconstruct::FinishOptions finish;
  /// How a frame becomes a view; empty: measure_view. Studies and tests hand in simulated views.
  std::function<Result<measurement::MeasuredView>(const Frame&)> measure_frame;
  /// >= 1. Threads that measure frames.
  int measure_threads = 1;
  /// >= 2. Frames that may be on their way before the oldest is given up: at 30 Hz a third of a
  /// second.
  int max_frames_underway = 10;
  /// >= 1. Measured views that may wait for registration before some are interpolated instead.
  int max_views_waiting = 4;
  /// > 1. All poses are optimized together each time the scan has grown by this factor.
  double refine_growth = 1.3;
  /// >= 2. Fewer views are not worth it.
  int min_refine_views = 60;
  /// > 0. Holes are looked for at most this often, s.
  double holes_period_s = 4.0;
  /// Monotonic seconds. Must be set.
  std::function<double()> now_s;
  /// May be null: then nothing is kept.
  std::shared_ptr<ScanJournal> journal;

  [[nodiscard]] Result<void> validate() const;
};

/// What an interrupted program had kept of a scan.
struct KeptScan {
  std::vector<AlignedView> views;     ///< by rising time, registered
  std::vector<Frame> texture_frames;  ///< by rising time
  editing::EditStack edits;
  std::shared_ptr<const reconstruct::FinishedScan>
      result;  ///< null where the scan has changed since
};

/// Owns its threads: some measure, one registers, one keeps the model, one optimizes beside them
/// and looks for holes, one finishes, one keeps the journal. All members are thread-safe and none
/// blocks.
class LiveScan {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<LiveScan>> create(
      std::shared_ptr<const calibration::Calibration> calibration, const LiveScanOptions& options,
      const KeptScan& kept = {});
  /// Stops all threads; what the journal was given, it is given a last commit for.
  ~LiveScan();
  LiveScan(const LiveScan&) = delete;
  LiveScan& operator=(const LiveScan&) = delete;

  /// The next frame of the sensor; times must rise.
  void offer(Frame frame);

  void start();
  void pause();
  /// The edit gets the time of the latest frame.
  void edit(editing::EditKind kind, std::vector<editing::BrushDab> dabs);
  void undo();
  void redo();
  /// Picks one of ScanSnapshot::reentry.
  void choose_reentry(std::size_t index);
  void finish();
  void cancel_finish();
  /// From now on this journal keeps the scan; what was scanned before is handed to it first.
  void keep_in(std::shared_ptr<ScanJournal> journal);

  /// The state now. The same object as before where nothing has changed.
  [[nodiscard]] std::shared_ptr<const ScanSnapshot> snapshot() const;
  /// Waits until all that was offered and asked is done; for tests and for programs without a
  /// window.
  void wait_until_idle() const;

 private:
  class Impl;
  explicit LiveScan(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace flytri::scan
