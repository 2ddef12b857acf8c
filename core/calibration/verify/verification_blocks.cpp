#include "core/calibration/verify/verification_blocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

/// Few enough that a sphere is straight along a block, enough to reduce the noise of single points.
constexpr std::size_t kBlockPoints = 8;

void cut_profile(const Profile& profile, VerificationBlock block,
                 std::vector<VerificationBlock>& blocks) {
  for (std::size_t first = 0; first + kBlockPoints <= profile.points.size();
       first += kBlockPoints) {
    block.position_mm.setZero();
    block.noise_mm = 0.0;
    for (std::size_t i = first; i < first + kBlockPoints; ++i) {
      block.position_mm += profile.points[i].position_mm / double(kBlockPoints);
      block.noise_mm += profile.points[i].deviation_mm.norm() / double(kBlockPoints);
    }
    blocks.push_back(block);
  }
}

}  // namespace

std::vector<std::vector<VerificationBlock>> cut_blocks(const std::vector<VerificationPose>& poses) {
  std::vector<std::vector<VerificationBlock>> blocks(poses.size());
  std::size_t line = 0;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const auto& views = poses[p].views;
    if (views.empty()) continue;
    const double middle_s = 0.5 * (views.front().time_s + views.back().time_s);
    const double half_s = 0.5 * (views.back().time_s - views.front().time_s);
    for (const View& view : views) {
      VerificationBlock block;
      block.sign = view.pattern == Pattern::kVertical ? 0.5 : -0.5;
      block.time = half_s > 0.0 ? (view.time_s - middle_s) / half_s : 0.0;
      for (const Profile& profile : view.profiles) {
        block.line = line++;
        cut_profile(profile, block, blocks[p]);
      }
    }
  }
  return blocks;
}

double residual_mm(const Calibration& calibration, bool of_difference) {
  const double v = calibration.of(Pattern::kVertical).depth_residual_mm.rms;
  const double h = calibration.of(Pattern::kHorizontal).depth_residual_mm.rms;
  return of_difference ? std::hypot(v, h) : std::max(v, h);
}

VerificationFigure make_figure(VerificationSymptom symptom, std::string name, double deviation_mm,
                               double uncertainty_mm, double residual_mm,
                               const VerificationOptions& options) {
  const double limit_mm =
      options.residual_factor * residual_mm + options.noise_factor * uncertainty_mm;
  return {symptom, std::move(name), deviation_mm, uncertainty_mm, limit_mm};
}

VerificationFigure form_figure(const std::vector<std::vector<VerificationBlock>>& blocks,
                               const std::vector<Eigen::VectorXd>& residuals,
                               const Calibration& calibration, const VerificationOptions& options) {
  double squares = 0.0, noise = 0.0, count = 0.0;
  for (const Eigen::VectorXd& of_pose : residuals) squares += of_pose.squaredNorm();
  for (const auto& of_pose : blocks) {
    for (const VerificationBlock& block : of_pose) {
      noise += block.noise_mm * block.noise_mm;
      count += 1.0;
    }
  }
  // Neighbors share speckle, so a block may scatter almost as much as a single point.
  const double expected_mm = std::hypot(residual_mm(calibration, false), std::sqrt(noise / count));
  return {VerificationSymptom::kForm, "scatter", std::sqrt(squares / count), 0.0,
          options.residual_factor * expected_mm};
}

SharedFit::SharedFit(Eigen::Index shared_count)
    : normal_(Eigen::MatrixXd::Zero(shared_count, shared_count)),
      right_(Eigen::VectorXd::Zero(shared_count)) {}

void SharedFit::add_pose(const Eigen::MatrixXd& shared, const Eigen::MatrixXd& own,
                         const Eigen::VectorXd& values, const std::vector<std::size_t>& cluster) {
  Pose pose{shared,
            own,
            shared - own * solve_each_least_squares(own, shared),
            values,
            values - own * solve_least_squares(own, values).x,
            cluster};
  normal_ += pose.projected.transpose() * pose.projected;
  right_ += pose.projected.transpose() * pose.projected_values;
  poses_.push_back(std::move(pose));
}

std::optional<SharedFit::Solution> SharedFit::solve() const {
  const Eigen::VectorXd modes = symmetric_eigen(normal_).values;
  constexpr double kDetermined = 1e-9;  // squared ratio; below it, the data do not determine a
                                        // direction
  if (poses_.empty() || modes[0] <= kDetermined * modes.maxCoeff()) {
    return std::nullopt;
  }
  const Eigen::MatrixXd inverse = normal_.inverse();
  Solution solution;
  solution.shared = inverse * right_;
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(normal_.rows(), normal_.cols());
  double clusters = 0.0;
  for (const Pose& pose : poses_) {
    const Eigen::VectorXd rest = pose.projected_values - pose.projected * solution.shared;
    Eigen::VectorXd score = Eigen::VectorXd::Zero(normal_.rows());
    for (Eigen::Index i = 0; i < rest.size(); ++i) {
      score += pose.projected.row(i).transpose() * rest[i];
      const auto k = static_cast<std::size_t>(i);
      if (k + 1 < pose.cluster.size() && pose.cluster[k + 1] == pose.cluster[k]) continue;
      scatter += score * score.transpose();
      score.setZero();
      clusters += 1.0;
    }
    const Eigen::VectorXd left = pose.values - pose.shared * solution.shared;
    solution.own.push_back(solve_least_squares(pose.own, left).x);
    solution.residuals.push_back(rest);
  }
  const double unknowns = static_cast<double>(normal_.rows());
  if (clusters <= unknowns) return std::nullopt;
  scatter *= clusters / (clusters - unknowns);
  solution.uncertainty = (inverse * scatter * inverse).diagonal().cwiseSqrt();
  return solution;
}

std::vector<std::size_t> clusters_of(const std::vector<VerificationBlock>& blocks, bool moves) {
  std::vector<std::size_t> clusters;
  clusters.reserve(blocks.size());
  for (const VerificationBlock& block : blocks) clusters.push_back(moves ? 0 : block.line);
  return clusters;
}

}  // namespace flytri::calibration
