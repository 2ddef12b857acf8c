/// @file  Controls the stages of a session: one scan and its measurements for each jaw and the
/// bite.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/session/background_work.h"
#include "app/session/case_store.h"
#include "app/session/notices.h"
#include "app/session/source_controller.h"
#include "core/scan/live_scan.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

/// A command that does not fit the phase of the scan does nothing; see scan::accepts().
class StageController {
 public:
  /// @param options  with now_s
  StageController(scan::LiveScanOptions options, SourceController& source,
                  BackgroundWork& background, Notices& notices);

  void start();
  void pause();
  /// @param close_holes_mm  as meshing::MeshOptions
  void finish(double close_holes_mm);
  /// As scan::LiveScan::finish_ahead, for the current stage.
  void finish_ahead(double close_holes_mm);
  void cancel_finish();
  void undo();
  void redo();
  void edit(const ui::EditSurface& command);
  void show_crossed(bool is_shown);
  void choose_reentry(std::size_t index);
  /// Empties the current stage; the case keeps what was in it. Does nothing for another stage.
  void clear(io::ScanStage stage);
  /// Shows what the case has kept of the current stage, and keeps what is shown.
  void bring_back();
  /// Starts an empty stage as a copy of the current one, see CaseFile::copy_stage. Turns to the
  /// copy, but stays if the copy keeps what was before a preparation: then it has the finished
  /// model, too.
  void copy_to(io::ScanStage stage);
  void add_measurement(io::Measurement measurement);
  void remove_measurement(std::size_t index);
  /// Keeps the occlusal plane of a stage, also in its case. @param points  none: found by itself
  void set_plane(io::ScanStage stage, const std::optional<OcclusalPoints>& points);
  /// Of the current stage. @return  whether it was kept: the case may refuse it
  bool add_margin(io::StoredMargin margin);
  /// The line of a margin that was drawn anew, on a newer model.
  void renew_margin(std::int64_t id, review::Margin line);
  void remove_margin(std::size_t index);

  /// Pauses, and turns to another stage.
  void select(io::ScanStage stage);
  /// Shows the stage that a new sensor is for: a jaw or a face.
  void begin();
  /// Creates the scan of the current stage if there is none, and sends it the frames. What the case
  /// has of the stage is loaded in the background.
  void show();

  /// Saves all scans and measurements in this case from now on.
  void save_in(const std::shared_ptr<CaseStore>& store);
  /// Forgets all scans, and continues with those of this case; null: without a case.
  void replace_by(std::shared_ptr<CaseStore> store);
  /// Forgets all scans. Those that the case has are loaded again by show().
  void forget();
  /// Pauses and takes no frames, until show(). @return  a function that waits, on any thread, until
  /// all that was scanned has reached the case
  [[nodiscard]] std::function<void()> come_to_rest();

  /// A function that waits, on any thread, until all that was scanned so far has reached the case.
  [[nodiscard]] std::function<void()> wait_until_kept() const;

  /// Of the current stage; null until the source is open.
  [[nodiscard]] const std::shared_ptr<scan::LiveScan>& scan() const { return scans_[stage_]; }
  [[nodiscard]] io::ScanStage stage() const { return io::kScanStages[stage_]; }
  /// What is known of a stage's finished model.
  struct StageModel {
    bool is_finished = false;  ///< if it is not loaded: perhaps an older one
    std::shared_ptr<const reconstruct::FinishedScan> scan;  ///< null: not finished, or not loaded
  };
  [[nodiscard]] StageModel model_of(io::ScanStage stage) const;
  /// The occlusal plane that the user has set. None: found by itself, or the stage is not loaded.
  [[nodiscard]] const std::optional<OcclusalPoints>& plane_of(io::ScanStage stage) const {
    return planes_[static_cast<std::size_t>(stage)];
  }
  /// Of the current stage.
  [[nodiscard]] const std::vector<io::Measurement>& measurements() const {
    return measurements_[stage_];
  }
  [[nodiscard]] const std::vector<io::StoredMargin>& margins() const { return margins_[stage_]; }
  /// The case that scans are saved in; null: none.
  [[nodiscard]] const std::shared_ptr<CaseStore>& store() const { return store_; }
  /// False while a scan is finishing, see scan::may_leave().
  [[nodiscard]] bool may_leave() const;
  /// True if a stage shows something that was scanned.
  [[nodiscard]] bool has_model() const;
  /// True if a scan would be lost by forget().
  [[nodiscard]] bool has_unsaved() const;
  /// The user has started to scan, and has not paused since.
  [[nodiscard]] bool is_started() const { return is_started_; }
  /// Adds what the window shows of the stages, and reports a failed finishing.
  void show_in(ui::AppView& view);

 private:
  [[nodiscard]] bool accepts(scan::ScanEvent event) const;
  void report_moved_projector(const ui::AppView& view);
  void use(std::size_t stage, const OpenedStage& opened);
  using Change = std::function<Result<void>(CaseStore&)>;
  /// Changes what the case has of a stage, in the background, and turns to `shown` afterwards.
  void change_stored(io::ScanStage changed, io::ScanStage shown, Change change);

  const scan::LiveScanOptions options_;
  SourceController& source_;
  BackgroundWork& background_;
  Notices& notices_;
  std::shared_ptr<CaseStore> store_;
  bool is_started_ = false;  ///< the user wants to scan
  std::size_t stage_ = 0;
  std::array<std::shared_ptr<scan::LiveScan>, io::kScanStages.size()> scans_;
  std::array<std::vector<io::Measurement>, io::kScanStages.size()> measurements_;
  std::array<std::optional<OcclusalPoints>, io::kScanStages.size()> planes_;
  std::array<std::vector<io::StoredMargin>, io::kScanStages.size()> margins_;
  std::int64_t latest_margin_ = 0;  ///< id of one that is in no case: negative
  std::array<bool, io::kScanStages.size()> is_loading_ = {};
  std::array<std::string, io::kScanStages.size()> load_failures_;
  std::string reported_failure_;
  bool has_reported_projector_ = false;
};

}  // namespace flytri::session
