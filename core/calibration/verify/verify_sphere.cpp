#include <cmath>
#include <utility>

#include "core/calibration/verify/estimate_metric.h"
#include "core/calibration/verify/sphere_poses.h"
#include "core/calibration/verify/verify.h"

namespace flytri::calibration {
namespace {

/// Shear that a sphere seems to have without any, see docs/figures.md.
constexpr double kLeanOfSlopes = 0.0026;

/// Shared unknowns: error of the radius, and depth of vertical minus horizontal.
constexpr Eigen::Index kShared = 2;

/// Adds the distances from the sphere of known radius and their derivatives to the fit.
void add_pose(SharedFit& fit, const std::vector<VerificationBlock>& blocks, const SpherePose& pose,
              double radius_mm, bool moves, bool as_bent) {
  const auto rows = static_cast<Eigen::Index>(blocks.size());
  Eigen::MatrixXd shared(rows, kShared);
  Eigen::VectorXd values(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const VerificationBlock& block = blocks[static_cast<std::size_t>(i)];
    const Vec3 from_center = block.position_mm - pose.at(block.time);
    const Vec3 out = from_center.normalized();
    shared.row(i) << 1.0, block.sign * out.z();
    const double aside = from_center.head<2>().squaredNorm() / (radius_mm * radius_mm);
    values[i] = as_bent ? out.z() * aside : distance_off(block, pose, radius_mm);
  }
  fit.add_pose(shared, rows_of_center(blocks, pose, moves), values, clusters_of(blocks, moves));
}

std::optional<SharedFit::Solution> solve_spheres(const SphereData& data,
                                                 const std::vector<VerificationPose>& poses,
                                                 double radius_mm, bool as_bent) {
  SharedFit fit(kShared);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (data.blocks[p].empty()) continue;
    add_pose(fit, data.blocks[p], data.spheres[p], radius_mm, poses[p].moves, as_bent);
  }
  return fit.solve();
}

/// Adds how far the ends of the volume are shifted sideways, as far as this sphere can tell.
void add_shear(VerificationReport& report, const std::vector<VerificationPose>& poses,
               double diameter_mm, const Calibration& calibration,
               const VerificationOptions& options) {
  const auto metric = estimate_metric(poses, diameter_mm);
  if (!metric) return;
  const double depth_mm = calibration.volume.size_mm.z();
  for (const Eigen::Index axis : {0, 1}) {
    VerificationFigure figure = make_figure(
        VerificationSymptom::kShear,
        axis == 0 ? "stage not square, along x" : "stage not square, along y",
        0.5 * depth_mm * metric->correction.shear[axis], 0.5 * depth_mm * metric->uncertainty[axis],
        residual_mm(calibration, false), options);
    // A slope shifts lines a little to one side, which looks like a lean of up to 0.15 degrees.
    figure.limit_mm += 0.5 * depth_mm * kLeanOfSlopes;
    const bool is_told = figure.limit_mm <= options.max_limit_share * depth_mm;
    if (is_told || !figure.good()) report.figures.push_back(std::move(figure));
  }
}

}  // namespace

Result<VerificationReport> check_on_sphere(const std::vector<VerificationPose>& poses,
                                           double diameter_mm, const Calibration& calibration,
                                           const VerificationOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (!(diameter_mm > 0.0)) {
    return fail(ErrorCode::kBadOption, "the sphere's diameter is {} mm, but must be above 0",
                diameter_mm);
  }
  const double radius_mm = 0.5 * diameter_mm;
  const SphereData data = gather_spheres(cut_blocks(poses), poses, radius_mm);
  VerificationReport report;
  if (static_cast<double>(data.kept) < options.min_share_on_object * double(data.found)) {
    report.reason = "too many measured points are not on the sphere; nothing else may be in view";
    return report;
  }
  const auto solution = solve_spheres(data, poses, radius_mm, false);
  const auto bent = solve_spheres(data, poses, radius_mm, true);
  if (!solution || !bent) {
    report.reason = "the sphere was hardly seen; hold it in the middle of the volume";
    return report;
  }
  // Change of the diameter if the calibration is bent by its residual.
  const double diameter_residual_mm =
      2.0 * std::abs(bent->shared[0]) * residual_mm(calibration, false);
  report.figures = {
      make_figure(VerificationSymptom::kDiameter, "diameter", 2.0 * solution->shared[0],
                  2.0 * solution->uncertainty[0], diameter_residual_mm, options),
      make_figure(VerificationSymptom::kOffset, "vertical minus horizontal", solution->shared[1],
                  solution->uncertainty[1], residual_mm(calibration, true), options),
      form_figure(data.blocks, solution->residuals, calibration, options)};
  add_shear(report, poses, diameter_mm, calibration, options);
  judge(report, calibration.volume, options);
  return report;
}

}  // namespace flytri::calibration
