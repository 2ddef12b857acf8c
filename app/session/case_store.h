/// @file  The open case of a session, shared by the threads that read and write it.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/report/case_facts.h"
#include "core/io/cases/case_journal.h"
#include "core/scan/live_scan.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// What a case contains of a stage, prepared to continue its scan.
struct OpenedStage {
  scan::KeptScan scan;
  std::vector<io::Measurement> measurements;
  std::optional<OcclusalPoints> plane;
  std::vector<io::StoredMargin> margins;
  std::vector<std::string> damage;  ///< what could not be read, one line each
  FrameIndex last_frame{-1};
  double last_time_s = 0.0;
};

using StagesWithViews = std::array<bool, io::kScanStages.size()>;

/// Thread-safe.
class CaseStore : public std::enable_shared_from_this<CaseStore> {
 public:
  explicit CaseStore(io::CaseFile file);

  /// The journal that saves a scan of this stage.
  [[nodiscard]] std::shared_ptr<scan::ScanJournal> journal(io::ScanStage stage);
  /// @param texts  for messages
  [[nodiscard]] Result<OpenedStage> load(io::ScanStage stage, const ui::Texts& texts = {});
  /// @param texts  for messages
  /// @errors  As load; kInsufficient: there is no model, or the scan has changed since.
  [[nodiscard]] Result<std::shared_ptr<const reconstruct::FinishedScan>> load_model(
      io::ScanStage stage, const ui::Texts& texts);
  /// For the report of a finished stage. Takes seconds if the scan is long.
  /// @errors  As report::facts_in; kInsufficient: something is not saved yet.
  [[nodiscard]] Result<report::ScanFacts> facts(io::ScanStage stage);
  [[nodiscard]] Result<io::CaseFields> fields();
  [[nodiscard]] Result<void> write_fields(const io::CaseFields& fields);
  [[nodiscard]] Result<void> write_calibration(const calibration::Calibration& calibration);
  /// Adds a check to the case's calibration, if it is the one that was checked and the case is not
  /// read-only.
  [[nodiscard]] Result<void> note_check(const calibration::Calibration& checked,
                                        const calibration::CalibrationCheck& check);
  /// None: the case has no calibration yet.
  [[nodiscard]] Result<std::optional<calibration::Calibration>> calibration();
  [[nodiscard]] Result<std::int64_t> add_measurement(io::ScanStage stage,
                                                     const io::Measurement& added);
  [[nodiscard]] Result<void> remove_measurement(std::int64_t id);
  /// The occlusal plane that the user has set; none: it is found by itself.
  [[nodiscard]] Result<std::optional<OcclusalPoints>> plane(io::ScanStage stage);
  [[nodiscard]] Result<void> write_plane(io::ScanStage stage,
                                         const std::optional<OcclusalPoints>& points);
  [[nodiscard]] Result<std::int64_t> add_margin(io::ScanStage stage, const io::StoredMargin& added);
  [[nodiscard]] Result<void> replace_margin(const io::StoredMargin& margin);
  [[nodiscard]] Result<void> remove_margin(std::int64_t id);
  /// What can be read of the case. Takes seconds if the scans are long.
  [[nodiscard]] Result<io::CaseSurvey> survey();
  /// As CaseFile::rescue_to. Takes seconds if the scans are long.
  [[nodiscard]] Result<io::CaseSurvey> rescue_to(const std::filesystem::path& path);
  /// See CaseFile::clear_stage. Committed: after a crash the stage is as it was, or cleared.
  [[nodiscard]] Result<void> clear(io::ScanStage stage);
  /// See CaseFile::bring_back_stage.
  [[nodiscard]] Result<void> bring_back(io::ScanStage stage);
  /// See CaseFile::copy_stage.
  [[nodiscard]] Result<void> copy(io::ScanStage from, io::ScanStage to, bool with_model);
  /// Adds an entry to the journal of the case and commits. A failure is remembered, see failure();
  /// a case that is read-only gets none.
  void note(const io::CaseEvent& event);
  /// True if a stage has views, also such as were cleared, or cannot be read.
  [[nodiscard]] bool has_views();
  /// Moves the case to another file, see CaseFile::move_to, and writes the fields there. Journals
  /// go on in the new file. Takes seconds if the scans are long.
  [[nodiscard]] Result<void> move_to(const std::filesystem::path& path, const Secret& passphrase,
                                     const io::CaseFields& fields);

  /// See CaseFile::passphrase.
  [[nodiscard]] Secret passphrase();

  // The window asks for these in each frame: they do not wait for a write.
  [[nodiscard]] std::string path() const;
  [[nodiscard]] bool is_read_only() const;
  /// Whether each stage had views when the case was opened, or a stage was last cleared or copied.
  [[nodiscard]] StagesWithViews stages_with_views() const;
  /// Damage was found, when the case was opened or since.
  [[nodiscard]] bool is_damaged() const;
  /// Whether each stage had a finished model then, perhaps an older one.
  [[nodiscard]] StagesWithViews stages_with_model() const;
  /// Whether each stage keeps a scan that was cleared.
  [[nodiscard]] StagesWithViews stages_with_kept_scan() const;
  /// Why something is not saved; empty: everything is. A failure is over as soon as all that waited
  /// is saved. It stays if something is lost for good, see CaseFile.
  [[nodiscard]] std::string failure() const;

 private:
  class Journal;
  struct Status {
    std::string path;
    bool is_read_only = false;
    bool is_damaged = false;
    StagesWithViews has_views = {}, has_model = {}, has_kept_scan = {};
    std::string waiting_failure;  ///< of records that will be written again
    std::string loss;             ///< of records that will not
  };
  /// Calls `writing` and remembers a failure.
  void write(const std::function<Result<void>(io::CaseFile&)>& writing);
  /// Makes the state of the file known.
  void update_status();
  /// Counts what the stages hold.
  void update_stages();
  /// Calls `change`, commits it, and makes known what the stages hold.
  [[nodiscard]] Result<void> change_stage(const std::function<Result<void>(io::CaseFile&)>& change);

  std::mutex mutex_;
  io::CaseFile file_;
  mutable std::mutex status_mutex_;
  Status status_;
};

/// The cases in a folder, the latest first.
[[nodiscard]] std::vector<ui::KnownCase> known_cases(const std::filesystem::path& folder);

/// The unnamed cases in a folder that no program has open, the latest first. Removes those without
/// views.
[[nodiscard]] std::vector<ui::KnownCase> unnamed_cases(const std::filesystem::path& folder);

}  // namespace flytri::session
