/// @file  A live scan: frames and the user's commands go in, immutable snapshots come out.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/base/task_thread.h"
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
  /// LiveScan sets its shutter.
  tracking::RegistrarOptions registration;
  /// Finite. Delay of the camera's last row after the first; 0: a global shutter, or not known.
  double readout_s = 0.0;
  live::LiveSurfaceOptions surface;
  reconstruct::FinishOptions finish;
  /// Makes a view of a frame. Empty: measure_view(). Studies and tests give simulated views.
  std::function<Result<measurement::MeasuredView>(const Frame&)> measure_frame;
  /// >= 1. Number of threads that measure frames.
  int measure_threads = 1;
  /// >= 2. Frames that may wait or be measured before the oldest is skipped. At 30 Hz, 10 frames
  /// are a third of a second.
  int max_frames_underway = 10;
  /// >= 1. With more measured views waiting, views are interpolated instead of registered.
  int max_views_waiting = 4;
  /// > 1. All poses are optimized together each time the scan has grown by this factor.
  double refine_growth = 1.3;
  /// >= 2. No optimization with fewer views.
  int min_refine_views = 60;
  /// > 0. Shortest time between two searches for holes, s.
  double holes_period_s = 4.0;
  /// Of the optimization and the search for holes. Tests raise it: on a busy machine they would
  /// wait.
  TaskThread::Priority background = TaskThread::Priority::kBackground;
  /// Monotonic seconds. Must be set.
  std::function<double()> now_s;
  /// Null: the scan is not saved.
  std::shared_ptr<ScanJournal> journal;

  [[nodiscard]] Result<void> validate() const;
};

/// A saved scan that is to be continued.
struct KeptScan {
  std::vector<AlignedView> views;     ///< by rising time, registered
  std::vector<Frame> texture_frames;  ///< by rising time
  editing::EditStack edits;
  std::shared_ptr<const reconstruct::FinishedScan>
      result;  ///< null: none, or the scan has changed since
  /// Of the last result, also if the scan has changed since. Null: there is none.
  std::shared_ptr<const editing::HeldSurface> held;
};

/// Owns its threads, see docs/architecture.md. All functions are thread-safe. Only those named
/// wait_... block. A command that does not fit the phase does nothing, see accepts().
class LiveScan {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<LiveScan>> create(
      std::shared_ptr<const calibration::Calibration> calibration, const LiveScanOptions& options,
      const KeptScan& kept = {});
  /// Stops all threads, and writes and commits the rest of the journal.
  ~LiveScan();
  LiveScan(const LiveScan&) = delete;
  LiveScan& operator=(const LiveScan&) = delete;

  /// The next frame of the sensor; times must rise.
  void offer(Frame frame);

  void start();
  void pause();
  /// Edits the surface. The edit gets the time of the latest frame.
  void edit(editing::EditKind kind, std::vector<editing::BrushDab> dabs);
  void undo();
  void redo();
  /// Shows also what has gone from the view, such as a tongue, or hides it again.
  void show_crossed(bool is_shown);
  /// Chooses one of ScanSnapshot::reentry.
  void choose_reentry(std::size_t index);
  /// @param close_holes_mm  as MeshOptions
  void finish(double close_holes_mm = 0.0);
  /// From now on, finishing begins whenever the scan is paused, or the sensor has seen no surface
  /// for 2 s. finish() with the same argument then has only the rest to do.
  void finish_ahead(double close_holes_mm = 0.0);
  void cancel_finish();
  /// From now on the scan is saved in this journal, with all that was scanned before.
  void keep_in(std::shared_ptr<ScanJournal> journal);

  /// The present state. The same object as before if nothing has changed.
  [[nodiscard]] std::shared_ptr<const ScanSnapshot> snapshot() const;
  /// Waits until all frames and commands are processed. For tests and for programs without a
  /// window.
  void wait_until_idle() const;
  /// Waits until all that was scanned so far has reached the journal.
  void wait_until_kept() const;

 private:
  class Impl;
  explicit LiveScan(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace flytri::scan
