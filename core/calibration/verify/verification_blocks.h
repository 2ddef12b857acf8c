/// @file  Pieces of profiles as the data of a hold check, with what belongs to a pose eliminated.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "core/calibration/verify/verification_report.h"

namespace flytri::calibration {

/// The mean of a few neighboring points of a profile.
struct VerificationBlock {
  Vec3 position_mm = Vec3::Zero();  ///< sensor frame
  double sign = 0.5;  ///< +1/2: vertical, -1/2: horizontal: a difference of the patterns is theirs
  double time = 0.0;  ///< -1..1 through the pose
  std::size_t line = 0;   ///< counts the profiles of all poses: what shares noise
  double noise_mm = 0.0;  ///< uncertainty of a single point
};

/// By pose.
[[nodiscard]] std::vector<std::vector<VerificationBlock>> cut_blocks(
    const std::vector<VerificationPose>& poses);

/// What the fit of the calibration left along z: of one pattern, or of the difference of both.
[[nodiscard]] double residual_mm(const Calibration& calibration, bool of_difference);

/// A deviation with the limit that the calibration's residual and the uncertainty give.
[[nodiscard]] VerificationFigure make_figure(VerificationSymptom symptom, std::string name,
                                             double deviation_mm, double uncertainty_mm,
                                             double residual_mm,
                                             const VerificationOptions& options);

/// What the fit of all poses left, against the noise of single points and the calibration.
/// @param residuals  by pose with blocks
[[nodiscard]] VerificationFigure form_figure(
    const std::vector<std::vector<VerificationBlock>>& blocks,
    const std::vector<Eigen::VectorXd>& residuals, const Calibration& calibration,
    const VerificationOptions& options);

/// Least squares whose unknowns are a few that all poses share, and some of each pose's own.
///
/// Those of a pose are projected out pose by pose. The covariance is that of clustered data: all
/// that a line (of a pose at rest) or a pose (in motion) contributes may be wrong together.
/// @source  Cameron and Miller, "A Practitioner's Guide to Cluster-Robust Inference", 2015.
class SharedFit {
 public:
  explicit SharedFit(Eigen::Index shared_count);

  /// @param shared   rows of the shared unknowns
  /// @param own      rows of the pose's own unknowns
  /// @param values   what the unknowns are to explain
  /// @param cluster  by row; rows of a cluster are neighbors
  void add_pose(const Eigen::MatrixXd& shared, const Eigen::MatrixXd& own,
                const Eigen::VectorXd& values, const std::vector<std::size_t>& cluster);

  struct Solution {
    Eigen::VectorXd shared;
    Eigen::VectorXd uncertainty;             ///< standard
    std::vector<Eigen::VectorXd> own;        ///< by pose
    std::vector<Eigen::VectorXd> residuals;  ///< by pose
  };
  /// Nothing if the data do not determine the shared unknowns.
  [[nodiscard]] std::optional<Solution> solve() const;

 private:
  struct Pose {
    Eigen::MatrixXd shared, own, projected;
    Eigen::VectorXd values, projected_values;
    std::vector<std::size_t> cluster;
  };
  Eigen::MatrixXd normal_;
  Eigen::VectorXd right_;
  std::vector<Pose> poses_;
};

}  // namespace flytri::calibration
