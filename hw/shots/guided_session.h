/// @file  A guided calibration: takes shots, checks each at once and saves them to a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/calibration/guide/guided_calibration.h"
#include "hw/shots/shot_source.h"

namespace flytri::shots {

/// One shot and the result of its check.
struct ShotOutcome {
  calibration::WantedShot shot;
  calibration::ShotVerdict verdict;
};

/// Completed placements are saved at once, so that a session can be continued later. When all
/// placements are complete and consistent, finish() writes calibration-set.json and
/// calibration.json.
class GuidedSession {
 public:
  /// Continues the session in the folder, or creates one there.
  /// @param plan  must equal the plan in the folder, if there is one
  /// @errors  kInconsistent: the folder contains a session with another plan; as
  ///          GuidedCalibration::create, write_guided_plan, read_guided_plan.
  [[nodiscard]] static Result<GuidedSession> open(const std::filesystem::path& folder,
                                                  const calibration::CalibrationPlan& plan,
                                                  std::shared_ptr<ShotSource> source,
                                                  const calibration::GuidedOptions& options = {});

  [[nodiscard]] const calibration::GuidedCalibration& guide() const { return guide_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Number of placements restored from an earlier session.
  [[nodiscard]] int restored() const { return restored_; }
  /// Why other placements could not be restored; one sentence each.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

  /// Takes the next shot and checks it. Call only while guide().wanted() has a value.
  /// @errors  Of the source and the disk; completed placements stay saved.
  [[nodiscard]] Result<ShotOutcome> shoot(const Progress& progress);

  /// Takes the shots of the wanted placement; stops at the first refused one.
  /// @param on_outcome  called after each shot
  /// @errors  As shoot.
  [[nodiscard]] Result<void> shoot_placement(
      const std::function<void(const ShotOutcome&)>& on_outcome, const Progress& progress);

  /// Removes the images of the placement, so that it is taken again.
  /// @errors  As remove_placement.
  [[nodiscard]] Result<void> reopen(std::size_t placement);

  /// Fits the complete session and writes set and calibration. Writes nothing if the set is
  /// refused.
  /// @errors  As GuidedCalibration::fit and write_file.
  /// @param note  of the calibration's history
  [[nodiscard]] Result<calibration::GuidedFit> finish(const Workers& workers,
                                                      const Progress& progress,
                                                      const std::string& note = {}) const;

 private:
  GuidedSession(std::filesystem::path folder, calibration::GuidedCalibration guide,
                std::shared_ptr<ShotSource> source);
  void restore();

  std::filesystem::path folder_;
  calibration::GuidedCalibration guide_;
  std::shared_ptr<ShotSource> source_;
  int restored_ = 0;
  std::vector<std::string> problems_;
};

/// Whether the images are to blame and must be taken again, rather than the devices or the disk.
[[nodiscard]] inline bool is_refusal(const Error& error) {
  return error.code == ErrorCode::kInconsistent || error.code == ErrorCode::kInsufficient;
}

}  // namespace flytri::shots
