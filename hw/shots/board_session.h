/// @file  A calibration by hand: takes, checks and saves the images of the board, pose by pose.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/calibration/fit/calibrate_board.h"
#include "core/calibration/guide/board_places.h"
#include "hw/shots/shot_source.h"

namespace flytri::shots {

/// The folder always holds a board set of the poses so far, so that a session can be continued
/// later.
class BoardSession {
 public:
  /// Continues the session in the folder, or creates one there.
  /// @param scene  must equal that of the folder, if there is one
  /// @errors  kInconsistent: the folder belongs to another sensor or board; as read_board_set
  ///          and create_folder.
  [[nodiscard]] static Result<BoardSession> open(const std::filesystem::path& folder,
                                                 const calibration::CalibrationScene& scene,
                                                 std::shared_ptr<ShotSource> source);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// In the order of taking.
  [[nodiscard]] const std::vector<calibration::BoardPlace>& places() const { return places_; }
  /// Number of poses that are done: the first ones.
  [[nodiscard]] std::size_t done() const { return set_.poses.size(); }

  /// Takes the images of a pose, in place of earlier ones.
  /// @param index  at most done()
  /// @errors  As check_board_pose: the images are to blame, see is_refusal(); of the source and the
  ///          disk. Poses that are done stay saved.
  [[nodiscard]] Result<void> take(std::size_t index, const Progress& progress);

  /// Fits the poses and writes calibration.json.
  /// @errors  As calibrate_board and write_calibration.
  /// @param note  of the calibration's history
  [[nodiscard]] Result<calibration::BoardCalibration> finish(const Workers& workers,
                                                             const Progress& progress,
                                                             const std::string& note = {}) const;

 private:
  BoardSession(std::filesystem::path folder, calibration::BoardSet set,
               std::shared_ptr<ShotSource> source);
  [[nodiscard]] Result<calibration::BoardPose> shoot(std::size_t index, const Progress& progress);

  std::filesystem::path folder_;
  calibration::BoardSet set_;
  std::shared_ptr<ShotSource> source_;
  std::vector<calibration::BoardPlace> places_;
};

}  // namespace flytri::shots
