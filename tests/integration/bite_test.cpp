/// The bite of a real jaw, recorded by an independent instrument, judged against its truth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "core/calibration/fit/calibrate.h"
#include "core/evaluation/best_fit.h"
#include "core/evaluation/surface_error.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"
#include "core/io/models/model.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "core/occlusion/clearance.h"
#include "core/occlusion/occlude.h"
#include "core/reconstruct/reconstruct.h"
#include "tests/support/places.h"

namespace flytri {
namespace {

const std::filesystem::path kBite = testing::shared_data() / "bite";

/// A finished scan, and where its world is in the frame of the true mesh.
struct Scan {
  TriangleMesh surface, truth;
  Isometry T_model_world = Isometry::Identity();
};

Scan reconstruct_part(const std::string& part, const calibration::Calibration& calibration) {
  const io::Recording recording = io::open_recording(kBite / part).value();
  const io::Truth truth = io::read_truth(kBite / part / "truth.json").value();
  const auto made =
      reconstruct::reconstruct(recording, calibration, {}, Workers(), Progress()).value();
  Scan scan{made.surface.mesh, io::read_model(truth.mesh).value().mesh};
  for (const reconstruct::FrameReport& frame : made.frames) {
    if (!frame.T_world_sensor) continue;
    const Isometry T_guess =
        truth.poses[frame.frame.at()].T_model_sensor * frame.T_world_sensor->inverse();
    const auto fit = evaluation::best_fit(evaluation::transformed(scan.surface, T_guess),
                                          scan.truth, {}, Workers());
    scan.T_model_world = fit.value().T_truth_result * T_guess;
    break;
  }
  return scan;
}

TEST(Bite, BringsTheJawsOfARealPatientTogether) {
  if (!std::filesystem::exists(kBite)) GTEST_SKIP() << "needs " << kBite;
  const auto set =
      io::read_calibration_set(testing::shared_data() / "calibration-intraoral").value();
  const auto calibration = calibration::calibrate(set, {}, Workers(), {}).value();
  const Scan upper = reconstruct_part("upper", calibration),
             lower = reconstruct_part("lower", calibration),
             bite = reconstruct_part("bite", calibration);
  const std::vector<occlusion::BiteScan> bites = {{"bite", bite.surface.vertices}};
  const auto found =
      occlusion::find_occlusion(upper.surface, lower.surface, bites, {}, Workers(), {});
  ASSERT_TRUE(found.has_value()) << found.error().message;

  const std::string name = (kBite / "upper" / "truth.json").string();
  const auto json = io::JsonPlace::parse(io::read_file(name).value(), name).value();
  const Isometry T_true = json.at("T_upper_lower").pose();
  const Isometry T_found =
      upper.T_model_world * found->T_upper_lower * lower.T_model_world.inverse();
  const Isometry T_error = T_found * T_true.inverse();
  const auto error_mm = [&](const Vec3& p_mm) { return (T_error * p_mm - p_mm).norm(); };
  const Vec3 middle_mm = upper.T_model_world * found->middle_mm;
  const double turned_deg = rotation_angle(T_error) * 180.0 / std::numbers::pi;
  EXPECT_LT(error_mm(middle_mm), 0.010);
  EXPECT_LT(turned_deg, 0.05);
  EXPECT_LT(error_mm(middle_mm), 3.0 * found->uncertainty_mm(found->middle_mm));
  // The last molar of the scanned side lies 10 mm from the middle.
  const std::vector<double> molar =
      json.at("landmarks_lower_mm").at("second_molar_left").numbers(3);
  const double molar_error_mm = error_mm(T_true * Vec3(molar[0], molar[1], molar[2]));
  EXPECT_LT(molar_error_mm, 0.015);

  // Distances between the true jaws, where they are near, at the true and at the found relation.
  const occlusion::JawSurface true_upper(upper.truth);
  const auto distances = [&](const Isometry& T_upper_lower) {
    return find_clearance(lower.truth, true_upper, T_upper_lower, 1.0, Workers());
  };
  const occlusion::Clearance expected = distances(T_true), measured = distances(T_found);
  std::vector<double> errors_mm;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::abs(expected[i]) < 0.5F && !std::isnan(measured[i]))
      errors_mm.push_back(std::abs(expected[i] - measured[i]));
  }
  ASSERT_GT(errors_mm.size(), 100U);
  const double distance_error_mm = evaluation::distance_statistics(errors_mm).median_mm;
  EXPECT_LT(distance_error_mm, 0.015);
  fmt::print(
      "Errors: {:.1f} µm in the middle of the bite, {:.1f} µm at the last molar, {:.3f} degrees, "
      "distances {:.1f} µm in the median\n",
      1e3 * error_mm(middle_mm), 1e3 * molar_error_mm, turned_deg, 1e3 * distance_error_mm);
}

}  // namespace
}  // namespace flytri
