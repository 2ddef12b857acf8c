#include "core/evaluation/best_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/geometry/decompositions.h"
#include "core/geometry/mesh_normals.h"

namespace flytri::evaluation {
namespace {

constexpr std::size_t kFootGrain = 512;
// Converged when no point moves by more than this share of the result's radius: 10 nm of 10 mm. A
// much smaller limit is never reached, because float positions are rounded.
constexpr double kSmallMotion = 1e-6;
// Directions with a smaller eigenvalue than this share of the largest are not determined by the
// shape; they are not changed.
constexpr double kFreeDirection = 1e-9;

// The vertices used. Center and radius normalize the unknowns, so that rotation and translation
// have similar weights.
struct Samples {
  std::vector<Vec3> points_mm;
  Vec3 center_mm = Vec3::Zero();
  double radius_mm = 1.0;
};

Samples draw_samples(const TriangleMesh& result, int sample_count) {
  const std::size_t all = result.vertices.size();
  const std::size_t count = std::min(all, static_cast<std::size_t>(sample_count));
  Samples samples;
  for (std::size_t i = 0; i < count; ++i) {
    samples.points_mm.push_back(result.vertices[i * all / count].position_mm.cast<double>());
    samples.center_mm += samples.points_mm.back() / static_cast<double>(count);
  }
  double sum = 0.0;
  for (const Vec3& p : samples.points_mm) sum += (p - samples.center_mm).squaredNorm();
  if (sum > 0.0) samples.radius_mm = std::sqrt(sum / static_cast<double>(count));
  return samples;
}

// The closest point of the true surface to a moved sample.
struct Foot {
  Vec3 point_mm = Vec3::Zero();  ///< the moved sample
  Vec3 normal = Vec3::Zero();    ///< of the triangle; zero if that is degenerate
  double offset_mm = 0.0;        ///< of the sample along the normal
  double distance_mm = 0.0;
};

Foot find_foot(const MeshDistance& to_truth, const TriangleMesh& truth, const Vec3& point_mm) {
  const MeshDistance::Closest closest = to_truth.closest(point_mm.cast<float>());
  Foot foot;
  foot.point_mm = point_mm;
  foot.normal = area_vector_mm2(truth, truth.triangles[closest.triangle]).stableNormalized();
  foot.offset_mm = foot.normal.dot(point_mm - closest.point_mm.cast<double>());
  foot.distance_mm = closest.distance_mm;
  return foot;
}

double tukey_cutoff_mm(const std::vector<Foot>& feet, double outlier_sigmas) {
  std::vector<double> distances_mm;
  distances_mm.reserve(feet.size());
  for (const Foot& foot : feet) distances_mm.push_back(foot.distance_mm);
  return outlier_sigmas * kSigmaOfMedian * median_of(distances_mm);
}

// Rotation about `center` and translation, the latter in units of the radius.
Twist solve_step(const std::vector<Foot>& feet, const Vec3& center_mm, double radius_mm,
                 double cutoff_mm) {
  Matrix6 normal_matrix = Matrix6::Zero();
  Twist right = Twist::Zero();
  for (const Foot& foot : feet) {
    if (foot.distance_mm >= cutoff_mm) continue;
    const double share = foot.distance_mm / cutoff_mm;
    const double weight = (1.0 - share * share) * (1.0 - share * share);
    Twist row;
    row << ((foot.point_mm - center_mm) / radius_mm).cross(foot.normal), foot.normal;
    normal_matrix += weight * row * row.transpose();
    right -= weight * foot.offset_mm / radius_mm * row;
  }
  const auto eigen = symmetric_eigen(normal_matrix);
  const double weakest = kFreeDirection * eigen.values.maxCoeff();
  Twist step = Twist::Zero();
  for (int k = 0; k < 6; ++k) {
    if (eigen.values[k] <= weakest) continue;
    const Twist direction = eigen.vectors.col(k);
    step += direction * (direction.dot(right) / eigen.values[k]);
  }
  return step;
}

Isometry motion_about(const Vec3& center_mm, Twist step, double radius_mm) {
  step.tail<3>() *= radius_mm;
  return Eigen::Translation3d(center_mm) * exp_twist(step) * Eigen::Translation3d(-center_mm);
}

}  // namespace

Result<void> BestFitOptions::validate() const {
  return OptionCheck("BestFitOptions")
      .at_least("sample_count", sample_count, 6)
      .at_least("max_iterations", max_iterations, 1)
      .above("outlier_sigmas", outlier_sigmas, 1.0)
      .result();
}

Result<BestFit> best_fit(const TriangleMesh& result, const TriangleMesh& truth,
                         const BestFitOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (result.vertices.empty() || truth.triangles.empty())
    return fail(ErrorCode::kInsufficient, "the {} is empty: no surface to fit",
                result.vertices.empty() ? "result" : "true mesh");
  const MeshDistance to_truth(truth);
  const Samples samples = draw_samples(result, options.sample_count);
  std::vector<Foot> feet(samples.points_mm.size());
  BestFit fit;
  while (fit.iterations < options.max_iterations && fit.outcome != BestFitOutcome::kConverged) {
    ++fit.iterations;
    const auto find = [&](std::size_t i) {
      feet[i] = find_foot(to_truth, truth, fit.T_truth_result * samples.points_mm[i]);
    };
    workers.for_each(feet.size(), find, kFootGrain);
    const Vec3 center_mm = fit.T_truth_result * samples.center_mm;
    const double cutoff_mm = tukey_cutoff_mm(feet, options.outlier_sigmas);
    const Twist step = solve_step(feet, center_mm, samples.radius_mm, cutoff_mm);
    fit.T_truth_result = motion_about(center_mm, step, samples.radius_mm) * fit.T_truth_result;
    if (step.norm() < kSmallMotion) fit.outcome = BestFitOutcome::kConverged;
  }
  return fit;
}

}  // namespace flytri::evaluation
