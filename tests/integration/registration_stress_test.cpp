#include <gtest/gtest.h>

#include "assets/sample_jaw/sample_jaw.h"
#include "tests/support/stress_scan.h"

namespace flytri {
namespace {

using testing::judge_scan;
using testing::StressCase;
using testing::StressVerdict;

/// Scans of the sample jaw. A wrong pose is the worst fault of a clinical scan: none may occur,
/// whatever the hand does. The milder the disturbance, the more views must be registered.
class RegistrationStress : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    sample_jaw::SampleJawOptions coarse;
    coarse.tooth_cell_mm = 0.3;
    coarse.gum_cell_mm = 0.6;
    const TriangleMesh jaw = sample_jaw::make_sample_jaw(coarse, Workers(2)).value();
    simulator_ = std::make_unique<simulated::ViewSimulator>(
        simulated::ViewSimulator::create(jaw, simulated::intraoral_sensor()).value());
  }
  static void TearDownTestSuite() { simulator_.reset(); }

  static StressVerdict run(const StressCase& by) {
    const testing::StressScan scan = take_stress_scan(*simulator_, by);
    tracking::Registrar registrar = tracking::Registrar::create().value();
    for (const auto& view : scan.views) registrar.add(view);
    return judge_scan(registrar.finish(), scan);
  }

  static std::unique_ptr<simulated::ViewSimulator> simulator_;
};

std::unique_ptr<simulated::ViewSimulator> RegistrationStress::simulator_;

/// A scan of 120 frames that a test then disturbs.
StressCase usual() {
  StressCase by;
  by.frame_count = 120;
  return by;
}

TEST_F(RegistrationStress, NormalSpeedKeepsEveryView) {
  for (const double speed : {0.25, 1.0, 2.0}) {
    StressCase by = usual();
    by.speed = speed;
    by.noise.correlation_samples = 1.5;
    const StressVerdict verdict = run(by);
    EXPECT_EQ(verdict.right, 120) << speed;
    EXPECT_EQ(verdict.wrong, 0) << speed;
  }
}

TEST_F(RegistrationStress, TooFastIsRejectedNotGuessed) {
  // 7 mm from view to view: neighbors share a third of their lines.
  StressCase by = usual();
  by.speed = 7.0;
  EXPECT_EQ(run(by).wrong, 0);
}

TEST_F(RegistrationStress, NoiseFromATenthToTwiceThatOfThePaper) {
  for (const double sigma_mm : {0.003, 0.06}) {
    StressCase by = usual();
    by.noise.sigma_mm = sigma_mm;
    by.noise.correlation_samples = 1.5;
    const StressVerdict verdict = run(by);
    EXPECT_EQ(verdict.right, 120) << sigma_mm;
    EXPECT_EQ(verdict.wrong, 0) << sigma_mm;
  }
}

TEST_F(RegistrationStress, WrongLabelsDoNotMoveViews) {
  StressCase by = usual();
  by.outlier_share = 0.05;
  const StressVerdict verdict = run(by);
  EXPECT_GE(verdict.right, 114);
  EXPECT_EQ(verdict.wrong, 0);
}

TEST_F(RegistrationStress, LostFramesAndPatternsDoNoHarm) {
  StressCase by = usual();
  by.missing_share = 0.2;
  by.one_pattern = {50, 60};
  const StressVerdict verdict = run(by);
  EXPECT_EQ(verdict.rejected, 0);
  EXPECT_EQ(verdict.wrong, 0);
}

TEST_F(RegistrationStress, FollowsAShakingHand) {
  StressCase by = usual();
  by.path.tremor_mm = 0.6;
  by.path.tremor_rad = 0.05;
  const StressVerdict verdict = run(by);
  EXPECT_GE(verdict.right, 114);
  EXPECT_EQ(verdict.wrong, 0);
}

TEST_F(RegistrationStress, ContinuesAfterALossFiveMillimetersAwayAndTurned) {
  StressCase by = usual();
  by.away = {60, 80};
  by.jump_frame = 80;
  by.jump_by = -25;
  by.jump_off << 0.06, -0.06, 0.15, 3.0, -3.0, 1.0;
  const StressVerdict verdict = run(by);
  // 20 frames see nothing; after that the hand rests long enough for all others.
  EXPECT_EQ(verdict.right, 100);
  EXPECT_EQ(verdict.rejected, 20);
  EXPECT_EQ(verdict.wrong, 0);
}

TEST_F(RegistrationStress, DoesNotJoinASurfaceAfterAJumpToAnUnseenPlace) {
  StressCase by = usual();
  by.jump_frame = 60;
  by.jump_by = 150;
  const StressVerdict verdict = run(by);
  EXPECT_EQ(verdict.right, 60);
  EXPECT_EQ(verdict.wrong, 0);
}

TEST_F(RegistrationStress, AllDisturbancesTogether) {
  StressCase by = usual();
  by.speed = 2.5;
  by.path.tremor_mm = 0.5;
  by.path.tremor_rad = 0.04;
  by.noise.sigma_mm = 0.05;
  by.noise.correlation_samples = 1.5;
  by.outlier_share = 0.1;
  by.missing_share = 0.1;
  by.away = {60, 75};
  by.jump_frame = 75;
  by.jump_by = -25;
  EXPECT_EQ(run(by).wrong, 0);
}

}  // namespace
}  // namespace flytri
