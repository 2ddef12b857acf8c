/// @file  Data and least squares of a verification: blocks of profile points, and a fit with
///          unknowns per pose.
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
  double sign = 0.5;     ///< +1/2: vertical, -1/2: horizontal; factor of the difference between the
                         ///< patterns
  double time = 0.0;     ///< -1..1 from the first to the last view of the pose
  std::size_t line = 0;  ///< number of the profile over all poses; its blocks share noise
  double noise_mm = 0.0;  ///< uncertainty of a single point
};

/// Cuts the profiles of each pose into blocks.
[[nodiscard]] std::vector<std::vector<VerificationBlock>> cut_blocks(
    const std::vector<VerificationPose>& poses);

/// RMS residual of the calibration along z: of one pattern, or of the difference of both.
[[nodiscard]] double residual_mm(const Calibration& calibration, bool of_difference);

/// A deviation with its limit, which follows from the calibration's residual and the uncertainty.
[[nodiscard]] VerificationFigure make_figure(VerificationSymptom symptom, std::string name,
                                             double deviation_mm, double uncertainty_mm,
                                             double residual_mm,
                                             const VerificationOptions& options);

/// Scatter after the fit of all poses, compared with the noise of single points and the
/// calibration's residual.
/// @param residuals  residuals of the blocks, for each pose that has blocks
[[nodiscard]] VerificationFigure form_figure(
    const std::vector<std::vector<VerificationBlock>>& blocks,
    const std::vector<Eigen::VectorXd>& residuals, const Calibration& calibration,
    const VerificationOptions& options);

/// Least squares with a few unknowns that all poses share, and some own unknowns per pose.
///
/// The own unknowns are eliminated pose by pose. The covariance assumes clustered data: all values
/// of a line (pose at rest) or of a pose (in motion) may share an error.
/// @source  Cameron and Miller, "A Practitioner's Guide to Cluster-Robust Inference", 2015.
class SharedFit {
 public:
  explicit SharedFit(Eigen::Index shared_count);

  /// @param shared   rows of the shared unknowns
  /// @param own      rows of the pose's own unknowns
  /// @param values   measured values
  /// @param cluster  by row; rows of a cluster are neighbors
  void add_pose(const Eigen::MatrixXd& shared, const Eigen::MatrixXd& own,
                const Eigen::VectorXd& values, const std::vector<std::size_t>& cluster);

  struct Solution {
    Eigen::VectorXd shared;
    Eigen::VectorXd uncertainty;             ///< standard
    std::vector<Eigen::VectorXd> own;        ///< by pose
    std::vector<Eigen::VectorXd> residuals;  ///< by pose
  };
  /// nullopt if the data do not determine the shared unknowns.
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

/// Clusters for SharedFit: blocks of a line share noise, those of a moving pose its jerk.
[[nodiscard]] std::vector<std::size_t> clusters_of(const std::vector<VerificationBlock>& blocks,
                                                   bool moves);

}  // namespace flytri::calibration
