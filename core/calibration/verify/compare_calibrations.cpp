#include "core/calibration/verify/compare_calibrations.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/calibration/verify/verification_blocks.h"
#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

constexpr std::size_t kRowStep = 12;
constexpr int kPlacesInRow = 5;
constexpr std::size_t kFewestPlaces = 200;
/// Two scales and two shears.
constexpr Eigen::Index kComparedUnknowns = 4;
constexpr Eigen::Index kRigidUnknowns = 6;
/// The map is linear in its numbers, but not together with the motion between the frames.
constexpr int kComparisonSteps = 8;
/// Above this share of the volume's depth, a correction does not make two calibrations one.
constexpr double kMostLeftShare = 0.003;

/// Where both locate the same lines at the same pixels.
struct CommonPlaces {
  std::vector<Vec3> measured_mm, reference_mm;
  std::vector<std::size_t> line;  ///< number over both patterns
};

void add_row(const Calibration& calibration, const Calibration& reference, Pattern pattern,
             LineIndex n, std::size_t along, CommonPlaces& places) {
  const LineRow& a = calibration.of(pattern).lines[n.at()][along];
  const LineRow& b = reference.of(pattern).lines[n.at()][along];
  if (!a.valid() || !b.valid()) return;
  const double from_px = std::max(a.area_min_px, b.area_min_px);
  const double to_px = std::min(a.area_max_px, b.area_max_px);
  if (to_px <= from_px) return;
  for (int i = 0; i < kPlacesInRow; ++i) {
    const LinePixel pixel{static_cast<double>(along),
                          from_px + (i + 0.5) / kPlacesInRow * (to_px - from_px)};
    places.measured_mm.push_back(calibration.locate(pattern, n, pixel));
    places.reference_mm.push_back(reference.locate(pattern, n, pixel));
    places.line.push_back(2 * n.at() + static_cast<std::size_t>(pattern));
  }
}

CommonPlaces common_places(const Calibration& calibration, const Calibration& reference) {
  CommonPlaces places;
  for (const Pattern pattern : kPatterns) {
    for (int n = 0; n < calibration.of(pattern).line_count(); ++n) {
      const LineIndex line(n);
      const std::size_t rows = std::min(calibration.of(pattern).lines[line.at()].size(),
                                        reference.of(pattern).lines[line.at()].size());
      for (std::size_t along = 0; along < rows; along += kRowStep)
        add_row(calibration, reference, pattern, line, along, places);
    }
  }
  return places;
}

Result<void> check_same_sensor(const Calibration& calibration, const Calibration& reference) {
  const bool same_lines = std::all_of(kPatterns.begin(), kPatterns.end(), [&](Pattern pattern) {
    return calibration.of(pattern).line_count() == reference.of(pattern).line_count();
  });
  if (same_lines && calibration.measurement_size == reference.measurement_size) return {};
  return fail(ErrorCode::kInconsistent,
              "the calibrations are of different sensors: the sizes of their images or their "
              "numbers of lines differ");
}

tl::unexpected<Error> hardly_overlap() {
  return fail(ErrorCode::kInsufficient,
              "the volumes of the calibrations hardly overlap; calibrate with the board again, and "
              "hold it through the whole volume");
}

std::vector<Vec3> mapped(std::span<const Vec3> places_mm, const MetricCorrection& correction) {
  const Eigen::Matrix3d map = correction.matrix();
  std::vector<Vec3> result;
  result.reserve(places_mm.size());
  for (const Vec3& p : places_mm) result.push_back(map * p);
  return result;
}

/// What one place says: three rows each.
struct Equations {
  Eigen::MatrixXd shared, own;
  Eigen::VectorXd values;
  std::vector<std::size_t> cluster;
};

Equations equations_of(const CommonPlaces& places, const std::vector<Vec3>& corrected_mm,
                       const Isometry& T_reference_corrected) {
  const auto rows = 3 * static_cast<Eigen::Index>(corrected_mm.size());
  Equations equations{Eigen::MatrixXd(rows, kComparedUnknowns),
                      Eigen::MatrixXd::Zero(rows, kRigidUnknowns),
                      Eigen::VectorXd(rows),
                      {}};
  const Eigen::Matrix3d R = T_reference_corrected.linear();
  for (std::size_t i = 0; i < corrected_mm.size(); ++i) {
    const auto row = 3 * static_cast<Eigen::Index>(i);
    const Vec3& p = places.measured_mm[i];
    const Vec3 q = T_reference_corrected * corrected_mm[i];
    equations.shared.block<3, 1>(row, 0) = R.leftCols<2>() * p.head<2>();
    equations.shared.block<3, 1>(row, 1) = R.col(2) * p.z();
    equations.shared.block<3, 2>(row, 2) = R.leftCols<2>() * p.z();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      equations.own.block<3, 1>(row, axis) = Vec3::Unit(axis).cross(q);
    equations.own.block<3, 3>(row, 3).setIdentity();
    equations.values.segment<3>(row) = places.reference_mm[i] - q;
    equations.cluster.insert(equations.cluster.end(), 3, places.line[i]);
  }
  return equations;
}

}  // namespace

Result<CalibrationComparison> compare_calibrations(const Calibration& calibration,
                                                   const Calibration& reference) {
  if (auto same = check_same_sensor(calibration, reference); !same)
    return tl::unexpected(same.error());
  const CommonPlaces places = common_places(calibration, reference);
  if (places.line.size() < kFewestPlaces) return hardly_overlap();
  CalibrationComparison comparison;
  MetricCorrection& correction = comparison.correction;
  for (int step = 0; step < kComparisonSteps; ++step) {
    const std::vector<Vec3> corrected_mm = mapped(places.measured_mm, correction);
    const Isometry T_reference_corrected = best_motion(corrected_mm, places.reference_mm);
    const Equations equations = equations_of(places, corrected_mm, T_reference_corrected);
    SharedFit fit(kComparedUnknowns);
    fit.add_pose(equations.shared, equations.own, equations.values, equations.cluster);
    const auto solution = fit.solve();
    if (!solution) return hardly_overlap();
    comparison.left_mm = std::sqrt(3.0 * solution->residuals.front().squaredNorm() /
                                   static_cast<double>(solution->residuals.front().size()));
    correction.lateral += solution->shared[0];
    correction.depth += solution->shared[1];
    correction.shear += solution->shared.segment<2>(2);
    comparison.lateral_sigma = solution->uncertainty[0];
    comparison.depth_sigma = solution->uncertainty[1];
    comparison.shear_sigma = solution->uncertainty.segment<2>(2);
  }
  const double limit_mm = kMostLeftShare * calibration.volume.size_mm.z();
  if (comparison.left_mm <= limit_mm) return comparison;
  return fail(ErrorCode::kInconsistent,
              "the calibrations locate the same lines {:.0f} µm apart, which no tilt or scale "
              "explains: they are of different sensors, or the sensor changed in between",
              1e3 * comparison.left_mm);
}

VerificationReport judge_comparison(const CalibrationComparison& comparison,
                                    const Calibration& calibration,
                                    const VerificationOptions& options) {
  const Vec3 border_mm = 0.5 * calibration.volume.size_mm;
  const double of_fit_mm = residual_mm(calibration, false);
  const MetricCorrection& correction = comparison.correction;
  VerificationReport report;
  const auto add = [&](VerificationSymptom symptom, std::string name, double per_mm, double sigma,
                       double distance_mm) {
    report.figures.push_back(make_figure(symptom, std::move(name), per_mm * distance_mm,
                                         sigma * distance_mm, of_fit_mm, options));
  };
  add(VerificationSymptom::kShear, "stage not square, along x", correction.shear.x(),
      comparison.shear_sigma.x(), border_mm.z());
  add(VerificationSymptom::kShear, "stage not square, along y", correction.shear.y(),
      comparison.shear_sigma.y(), border_mm.z());
  add(VerificationSymptom::kScale, "scale of the target", correction.lateral - 1.0,
      comparison.lateral_sigma, border_mm.x());
  add(VerificationSymptom::kScale, "scale of the stage", correction.depth - 1.0,
      comparison.depth_sigma, border_mm.z());
  judge(report, calibration.volume, options);
  return report;
}

}  // namespace flytri::calibration
