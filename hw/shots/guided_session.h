/// @file  A calibration at the chair: shots from a source, judged at once, kept in a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/calibration/guide/guided_calibration.h"
#include "hw/shots/shot_source.h"

namespace flytri::shots {

/// What became of one shot.
struct ShotOutcome {
  calibration::WantedShot shot;
  calibration::ShotVerdict verdict;
};

/// Placements that are done are on disk at once; whoever opens the folder again goes on with them.
/// When all are there and fit each other, calibration-set.json and calibration.json are written.
class GuidedSession {
 public:
  /// Takes up the session of the folder, or begins one there.
  /// @param plan  must be the folder's own, where there is one
  /// @errors  kInconsistent: the folder holds a session with another plan; as
  ///          GuidedCalibration::create, write_guided_plan, read_guided_plan.
  [[nodiscard]] static Result<GuidedSession> open(const std::filesystem::path& folder,
                                                  const calibration::CalibrationPlan& plan,
                                                  std::shared_ptr<ShotSource> source,
                                                  const calibration::GuidedOptions& options = {});

  [[nodiscard]] const calibration::GuidedCalibration& guide() const { return guide_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Placements taken over from an earlier session.
  [[nodiscard]] int restored() const { return restored_; }
  /// Why others of them were not, a sentence each.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

  /// Takes the wanted shot and judges it. Call only while something is wanted.
  /// @errors  Of the source, and of the disk; what is done so far is kept.
  [[nodiscard]] Result<ShotOutcome> shoot(const Progress& progress);

  /// Takes the shots of the wanted placement, up to the first that is refused.
  /// @param tell  hears of each
  /// @errors  As shoot.
  [[nodiscard]] Result<void> shoot_placement(const std::function<void(const ShotOutcome&)>& tell,
                                             const Progress& progress);

  /// The placement is wanted again; its images are removed.
  /// @errors  As remove_placement.
  [[nodiscard]] Result<void> reopen(std::size_t placement);

  /// Fits the complete session and writes set and calibration; neither, if the set is refused.
  /// @errors  As GuidedCalibration::fit and write_file.
  [[nodiscard]] Result<calibration::GuidedFit> finish(const Workers& workers,
                                                      const Progress& progress) const;

 private:
  GuidedSession(std::filesystem::path folder, calibration::GuidedCalibration guide,
                std::shared_ptr<ShotSource> source);
  void restore();

  std::filesystem::path folder_;
  calibration::GuidedCalibration guide_;
  std::shared_ptr<ShotSource> source_;
  int restored_ = 0;
  std::vector<std::string> complaints_;
};

/// Whether the images are at fault, so that some are to be taken again, and not devices or disk.
[[nodiscard]] inline bool is_refusal(const Error& error) {
  return error.code == ErrorCode::kInconsistent || error.code == ErrorCode::kInsufficient;
}

}  // namespace flytri::shots
