/// @file  A growing scan: the fate of each frame, the phases, the edits and the finishing. One
/// thread owns it; long work runs on threads of its own.
#pragma once

#include <functional>
#include <future>
#include <optional>
#include <set>

#include "core/base/task_thread.h"
#include "core/calibration/verify/pattern_shift.h"
#include "core/scan/background_refinement.h"
#include "core/scan/distance_gauge.h"
#include "core/scan/finishing_thread.h"
#include "core/scan/frame_counter.h"
#include "core/scan/frame_intake.h"
#include "core/scan/journal_thread.h"
#include "core/scan/live_model.h"
#include "core/scan/live_scan.h"
#include "core/scan/model_thread.h"
#include "core/scan/reentry_images.h"
#include "core/scan/snapshot_board.h"

namespace flytri::scan {

/// Used by the thread that owns it, except for the functions marked "for any thread".
class GrowingScan {
 public:
  /// Lets the owner's thread call a function. May be called from any thread.
  using Ask = std::function<void(std::function<void()>)>;

  GrowingScan(std::shared_ptr<const calibration::Calibration> calibration,
              const LiveScanOptions& options, tracking::Registrar registrar, LiveModel model,
              const KeptScan& kept, Ask ask);

  /// What else has arrived from the sensor.
  struct Arrivals {
    std::int64_t offered = 0;  ///< frames so far
    bool is_late = false;  ///< views are waiting: interpolate this one instead of registering it
  };
  void take(const IntakeResult& result, const Arrivals& arrivals);

  void start();
  void pause();
  void edit(editing::EditKind kind, std::vector<editing::BrushDab> dabs);
  void change_edits(void (editing::EditStack::*change)());
  void show_crossed(bool is_shown) { model_.show_crossed(is_shown); }
  void choose_reentry(std::size_t index);
  void keep_in(std::shared_ptr<ScanJournal> journal);
  void finish(double close_holes_mm);
  void finish_ahead(double close_holes_mm);

  // For any thread.
  [[nodiscard]] std::shared_ptr<const ScanSnapshot> snapshot();
  void cancel_finish() const { finishing_.cancel(); }
  /// Tasks that are waiting or running on its threads.
  [[nodiscard]] std::size_t pending() const;
  /// Waits until the journal has written all that it was given.
  void wait_until_kept() const { journal_.wait_until_idle(); }
  /// Cancels all long work.
  void cancel_all() const;
  /// Writes the rest of the journal and ends all threads. Call it after the owner's thread has
  /// ended.
  void stop();

 private:
  /// Unless the hand rests, the model is rebuilt with better poses only if these move the surface
  /// by more than this share of a cell. Less is not visible, and a rebuild takes as long as the
  /// first build.
  static constexpr double kToleratedCells = 0.2;

  /// Views for the model, collected while the model's thread is busy.
  struct Waiting {
    std::vector<AlignedView> views;
    std::vector<double> offered_at_s;  ///< when their frames were offered
  };
  void take_texture(const Frame& frame);
  void take_view(const IntakeResult& result, bool is_late);
  void register_view(const IntakeResult& result, const std::shared_ptr<const View>& view,
                     bool is_late);
  void watch_projectors(const AlignedView& registered);
  void missed(double time_s, const std::string& reason);
  void show_frame(const IntakeResult& result, std::shared_ptr<const View> view);
  void hand_over_growth(std::optional<double> offered_at_s);
  void hand_over_waiting();
  void hand_over_later();
  void restore(const KeptScan& kept);
  /// @param also  shown together with the new phase: who sees a result may leave the stage at once
  void step(ScanEvent event, const std::function<void(ScanSnapshot&)>& also = {});
  void show_reentry();
  void take_edits();
  void show_edits();
  /// @param tolerated_cells  see ModelThread::follow
  void take_refined(const std::vector<AlignedView>& refined, double tolerated_cells);
  void retire_past();
  void begin_run(double close_holes_mm);
  void watch_for_rest(bool sees_surface);
  void come_to_rest();
  void begin_run_ahead();
  void end_run_ahead();
  void take_output();
  void take_back(FinishingOutput& output);
  /// Of views_before_finishing_.
  [[nodiscard]] FinishingWork finishing_work() const;
  void take_result(std::shared_ptr<const reconstruct::FinishedScan> result);
  void take_no_result(const Error& why);
  void journal(JournalThread::Entry entry) { journal_.write(std::move(entry)); }
  void journal_view(const std::shared_ptr<const View>& view);
  [[nodiscard]] bool has_model() const { return known_views_ > 0; }
  /// With their points as measured. During a run of finishing: as they were when it began.
  [[nodiscard]] std::vector<AlignedView> measured_views() const {
    return registrar_ != nullptr ? registrar_->measured_views() : views_before_finishing_;
  }

  const std::shared_ptr<const calibration::Calibration> calibration_;
  const LiveScanOptions options_;
  const Ask ask_;
  SnapshotBoard board_;

  /// Null during a run of finishing: the finishing thread has it then.
  std::unique_ptr<tracking::Registrar> registrar_;
  std::vector<AlignedView> views_before_finishing_;
  std::set<FrameIndex> journaled_;  ///< frames whose views the present journal has
  ScanPhase phase_ = ScanPhase::kPreview;
  FrameCounter frame_counter_;
  editing::EditStack edits_;
  std::shared_ptr<const editing::HeldSurface> held_;  ///< of the last result
  ReentryImages pictures_;
  Waiting waiting_;
  bool is_model_asked_ = false;      ///< the model's thread will report when it is done
  std::vector<double> redundant_s_;  ///< times of views to retire
  std::size_t known_views_ = 0;      ///< registered
  int missed_in_a_row_ = 0;
  /// Of the present run of finishing; invalid: there is none.
  std::future<FinishingOutput> run_;
  int runs_ = 0;  ///< begun so far
  /// Close holes of this width in runs ahead; none: no runs ahead.
  std::optional<double> ahead_mm_;
  std::shared_ptr<const reconstruct::FinishedScan> ahead_;  ///< what that run has found, or null
  std::int64_t offered_ = 0;
  double last_time_s_ = 0.0, scanned_s_ = 0.0;
  std::optional<double> seen_at_s_;  ///< when a view was measured last, or the scan was started
  bool is_away_ = false;             ///< the sensor has seen no surface for some seconds
  DistanceGauge distance_;
  calibration::PatternShiftGauge pattern_shift_;

  // Destroyed first: these threads use the members above.
  JournalThread journal_;
  TaskThread background_thread_, rest_thread_;
  BackgroundRefinement refinement_;
  ModelThread model_;
  FinishingThread finishing_;
};

}  // namespace flytri::scan
