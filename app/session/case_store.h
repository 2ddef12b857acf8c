/// @file  The open case of a session, shared by the threads that read and write it.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/io/cases/case_file.h"
#include "core/scan/live_scan.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// What a case contains of a stage, prepared to continue its scan.
struct OpenedStage {
  scan::KeptScan scan;
  std::vector<io::Measurement> measurements;
  std::vector<std::string> damage;  ///< what could not be read, one line each
  FrameIndex last_frame{-1};
  double last_time_s = 0.0;
};

/// Thread-safe.
class CaseStore : public std::enable_shared_from_this<CaseStore> {
 public:
  explicit CaseStore(io::CaseFile file) : file_(std::move(file)) {}

  /// The journal that saves a scan of this stage.
  [[nodiscard]] std::shared_ptr<scan::ScanJournal> journal(io::ScanStage stage);
  [[nodiscard]] Result<OpenedStage> load(io::ScanStage stage);
  [[nodiscard]] Result<io::CaseFields> fields();
  [[nodiscard]] Result<void> write_fields(const io::CaseFields& fields);
  [[nodiscard]] Result<void> write_calibration(const calibration::Calibration& calibration);
  /// None: the case has no calibration yet.
  [[nodiscard]] Result<std::optional<calibration::Calibration>> calibration();
  [[nodiscard]] Result<std::int64_t> add_measurement(io::ScanStage stage,
                                                     const io::Measurement& added);
  [[nodiscard]] Result<void> remove_measurement(std::int64_t id);
  [[nodiscard]] Result<bool> has_views(io::ScanStage stage);

  [[nodiscard]] std::string path() const;
  [[nodiscard]] bool is_read_only() const;
  /// The damage that was found, one line each.
  [[nodiscard]] std::vector<std::string> damage() const;
  /// Why something is not saved; empty: everything is. A failure is over as soon as all that waited
  /// is saved. It stays if something is lost for good, see CaseFile.
  [[nodiscard]] std::string failure() const;

 private:
  class Journal;
  /// Calls `writing` and remembers a failure.
  void write(const std::function<Result<void>(io::CaseFile&)>& writing);

  mutable std::mutex mutex_;
  io::CaseFile file_;
  std::string waiting_failure_;  ///< of records that will be written again
  std::string loss_;             ///< of records that will not
};

/// The cases in a folder, the latest first.
[[nodiscard]] std::vector<ui::KnownCase> known_cases(const std::filesystem::path& folder);

}  // namespace flytri::session
