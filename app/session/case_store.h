/// @file  The open case of a session, shared by the threads that write to it and read it.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/interchange/case_file.h"
#include "core/pipeline/live_scan.h"
#include "ui/app_view.h"

namespace flytri {

/// What a stage of a case holds, made ready for a scan to go on.
struct OpenedStage {
  KeptScan scan;
  std::vector<Measurement> measurements;
  std::vector<std::string> damage;  ///< what could not be read, a line each
  FrameIndex last_frame{-1};
  double last_time_s = 0.0;
};

/// Thread-safe.
class CaseStore : public std::enable_shared_from_this<CaseStore> {
 public:
  explicit CaseStore(CaseFile file) : file_(std::move(file)) {}

  /// Keeps what a scan of this stage measures.
  [[nodiscard]] std::shared_ptr<ScanJournal> journal(ScanStage stage);
  [[nodiscard]] Result<OpenedStage> load(ScanStage stage);
  [[nodiscard]] Result<CaseFields> fields();
  [[nodiscard]] Result<void> write_fields(const CaseFields& fields);
  [[nodiscard]] Result<void> write_calibration(const Calibration& calibration);
  /// None: the case has none yet.
  [[nodiscard]] Result<std::optional<Calibration>> calibration();
  [[nodiscard]] Result<std::int64_t> add_measurement(ScanStage stage, const Measurement& added);
  [[nodiscard]] Result<void> remove_measurement(std::int64_t id);
  [[nodiscard]] Result<bool> has_views(ScanStage stage);

  [[nodiscard]] std::string path() const;
  [[nodiscard]] bool is_read_only() const;
  /// What was found damaged, a line each.
  [[nodiscard]] std::vector<std::string> damage() const;
  /// Why the latest writing failed; empty: all is kept.
  [[nodiscard]] std::string failure() const;

 private:
  class Journal;
  /// Does something with the file; a failure is remembered.
  void write(const std::function<Result<void>(CaseFile&)>& writing);

  mutable std::mutex mutex_;
  CaseFile file_;
  std::string failure_;
};

/// The cases of a folder, the latest first. Those that cannot be read are left out.
[[nodiscard]] std::vector<ui::KnownCase> known_cases(const std::filesystem::path& folder);

}  // namespace flytri
