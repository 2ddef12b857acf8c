#include "hw/shots/verification_shots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/calibration/fit/calibrate.h"
#include "core/calibration/verify/verify.h"
#include "hw/shots/simulated_shots.h"
#include "hw/simulated/datasets/simulate_calibration_set.h"

namespace flytri::shots {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Calibrated with the exposure of a guided session, so that near planes are not overexposed.
const calibration::Calibration& calibration() {
  static const calibration::Calibration kCalibration = [] {
    simulated::CalibrationSetOptions options;
    options.plane_count = 7;
    options.sensor.chip.line_level *= 0.5;
    return calibration::calibrate(simulated::take_calibration_set(options, Workers(2), {}).value(),
                                  {}, Workers(2), {})
        .value();
  }();
  return kCalibration;
}

calibration::VerificationReport look_at_plane(SimulatedShots& shots) {
  std::vector<calibration::VerificationPose> poses;
  for (const double z_mm : {-5.0, -2.3, 0.4, 2.7, 5.3}) {
    poses.push_back(take_verification_pose(shots, z_mm, calibration(), {}).value());
  }
  return calibration::check_on_plane(poses, calibration()).value();
}

TEST(VerificationShots, TheUnchangedVirtualSensorPassesForEachNoiseSeed) {
  for (const std::uint64_t seed : {11U, 12U, 13U, 14U}) {
    const auto shots =
        SimulatedShots::create(simulated::intraoral_sensor(), {.seed = seed}).value();
    const calibration::VerificationReport report = look_at_plane(*shots);
    EXPECT_EQ(report.outcome, calibration::VerificationOutcome::kValid) << report.reason;
    for (const calibration::VerificationFigure& figure : report.figures) {
      EXPECT_TRUE(figure.good()) << figure.name << " " << 1e3 * figure.deviation_mm << " µm of "
                                 << 1e3 * figure.limit_mm;
    }
  }
}

TEST(VerificationShots, DetectsAProjectorRotationOf0_2Milliradians) {
  const auto shots = SimulatedShots::create(simulated::intraoral_sensor()).value();
  ShotFaults faults;
  faults.sensor = shots->sensor();
  faults.sensor->projectors[0].T_sensor_projector.rotate(Eigen::AngleAxisd(0.2e-3, Vec3::UnitY()));
  ASSERT_TRUE(shots->set_faults(faults).has_value());
  const calibration::VerificationReport report = look_at_plane(*shots);
  EXPECT_EQ(report.outcome, calibration::VerificationOutcome::kBroken);
  // 0.2 mrad at 80 mm are 16 µm across the lines; at 7° triangulation angle, 130 µm in depth.
  EXPECT_NEAR(std::abs(report.figures[0].deviation_mm), 0.130, 0.015);
  EXPECT_THAT(report.meanings, Contains(HasSubstr("different depths")));
}

TEST(VerificationShots, DetectsACameraShiftOf20Micrometers) {
  const auto shots = SimulatedShots::create(simulated::intraoral_sensor()).value();
  ShotFaults faults;
  faults.sensor = shots->sensor();
  faults.sensor->camera.T_sensor_camera.pretranslate(Vec3(0.02, 0.0, 0.0));
  ASSERT_TRUE(shots->set_faults(faults).has_value());
  EXPECT_EQ(look_at_plane(*shots).outcome, calibration::VerificationOutcome::kBroken);
}

TEST(VerificationShots, RefusesAMovingObject) {
  /// The object moves away before every shot.
  class Sliding final : public ShotSource {
   public:
    Result<void> start() override { return {}; }
    void stop() override {}
    Result<cv::Mat> take(calibration::ShotKind kind, double z_mm,
                         const Progress& progress) override {
      return shots_->take(kind, z_mm + 0.02 * ++taken_, progress);
    }
    Result<cv::Mat> look(calibration::ShotKind kind, double z_mm,
                         const Progress& progress) override {
      return shots_->look(kind, z_mm, progress);
    }
    std::string name() const override { return "sliding"; }

   private:
    std::unique_ptr<SimulatedShots> shots_ =
        SimulatedShots::create(simulated::intraoral_sensor()).value();
    int taken_ = 0;
  };
  Sliding sliding;
  const auto pose = take_verification_pose(sliding, 0.0, calibration(), {});
  ASSERT_FALSE(pose.has_value());
  EXPECT_THAT(pose.error().message, HasSubstr("moved by 40 µm"));
}

}  // namespace
}  // namespace flytri::shots
