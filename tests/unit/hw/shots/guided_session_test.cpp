#include "hw/shots/guided_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/shots/simulated_shots.h"
#include "tests/support/temporary_folder.h"

namespace flytri::shots {
namespace {

using ::testing::HasSubstr;

constexpr int kPlanes = 5;

calibration::CalibrationPlan small_plan() {
  return plan_of(simulated::intraoral_sensor(), kPlanes);
}

std::shared_ptr<SimulatedShots> make_shots() {
  return SimulatedShots::create(simulated::intraoral_sensor()).value();
}

/// Takes good shots until the shot `kind` of plane `plane` is next.
void take_until(GuidedSession& session, std::size_t plane, calibration::ShotKind kind) {
  while (const auto shot = session.guide().wanted()) {
    if (shot->place.plane == plane && shot->kind == kind) return;
    const auto outcome = session.shoot({});
    ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
    ASSERT_TRUE(outcome->verdict.good()) << outcome->verdict.finding;
  }
}

TEST(GuidedSession, ContinuesAfterAnInterruptionWithTheSameResultAsTheOfflineCommand) {
  const TemporaryFolder folder;
  const auto shots = make_shots();
  {
    auto session = GuidedSession::open(folder.path(), small_plan(), shots).value();
    ASSERT_NO_FATAL_FAILURE(take_until(session, 2, calibration::ShotKind::kDotsTexture));
  }
  auto session = GuidedSession::open(folder.path(), small_plan(), shots).value();
  EXPECT_EQ(session.restored(), 5);  // both targets of two planes, the white plane of the third
  EXPECT_TRUE(session.problems().empty());
  EXPECT_EQ(session.guide().wanted()->kind, calibration::ShotKind::kDots);
  ASSERT_NO_FATAL_FAILURE(take_until(session, kPlanes, calibration::ShotKind::kDark));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "calibration-set.json"));
  const auto fit = session.finish(Workers(2), {});
  ASSERT_TRUE(fit.has_value()) << fit.error().message;

  const auto set = io::read_calibration_set(folder.path());
  ASSERT_TRUE(set.has_value()) << set.error().message;
  const auto offline = calibration::calibrate(*set, {}, Workers(2), {});
  ASSERT_TRUE(offline.has_value());
  const auto written = io::read_calibration(folder.path() / "calibration.json");
  ASSERT_TRUE(written.has_value());
  for (const Pattern pattern : kPatterns) {
    const double rms_mm = offline->of(pattern).depth_residual_mm.rms;
    EXPECT_EQ(fit->calibration.of(pattern).depth_residual_mm.rms, rms_mm);
    EXPECT_NEAR(written->of(pattern).depth_residual_mm.rms, rms_mm, 1e-8);  // rounded in JSON
    EXPECT_LT(rms_mm, 6e-3);  // as of the shared set: localization noise of single samples
  }
  EXPECT_EQ(fit->calibration.x_mm.residual.rms, offline->x_mm.residual.rms);
}

TEST(GuidedSession, ASensorWithoutATextureCameraIsCalibratedToo) {
  const TemporaryFolder folder;
  calibration::CalibrationPlan plan = small_plan();
  plan.has_texture = false;
  {
    auto session = GuidedSession::open(folder.path(), plan, make_shots()).value();
    ASSERT_NO_FATAL_FAILURE(take_until(session, 1, calibration::ShotKind::kDark));
  }
  EXPECT_FALSE(GuidedSession::open(folder.path(), small_plan(), make_shots()).has_value());
  auto session = GuidedSession::open(folder.path(), plan, make_shots()).value();
  EXPECT_EQ(session.restored(), 2);
  ASSERT_NO_FATAL_FAILURE(take_until(session, kPlanes, calibration::ShotKind::kDark));
  const auto fit = session.finish(Workers(2), {});
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  EXPECT_FALSE(fit->calibration.has_texture());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "z00_t.png"));
  const auto read = io::read_calibration(folder.path() / "calibration.json");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_FALSE(read->has_texture());
  EXPECT_FALSE(io::read_calibration_set(folder.path()).value().has_texture());
}

TEST(GuidedSession, TakesADamagedImageAgain) {
  const TemporaryFolder folder;
  {
    auto session = GuidedSession::open(folder.path(), small_plan(), make_shots()).value();
    ASSERT_NO_FATAL_FAILURE(take_until(session, 1, calibration::ShotKind::kDark));
  }
  ASSERT_TRUE(io::write_file(folder.path() / "z00_h.png", "no image").has_value());
  const auto session = GuidedSession::open(folder.path(), small_plan(), make_shots()).value();
  ASSERT_EQ(session.problems().size(), 1U);
  EXPECT_THAT(session.problems().front(), HasSubstr("z00_h.png"));
  EXPECT_EQ(session.guide().wanted()->placement, 0U);
  EXPECT_TRUE(session.guide().is_done(1));
}

TEST(GuidedSession, RefusesAFolderWithAnotherPlan) {
  const TemporaryFolder folder;
  ASSERT_TRUE(GuidedSession::open(folder.path(), small_plan(), make_shots()).has_value());
  const auto other =
      GuidedSession::open(folder.path(), plan_of(simulated::intraoral_sensor(), 9), make_shots());
  ASSERT_FALSE(other.has_value());
  EXPECT_EQ(other.error().code, ErrorCode::kInconsistent);
}

TEST(GuidedSession, DeletesTheImagesOfAReopenedPlane) {
  const TemporaryFolder folder;
  auto session = GuidedSession::open(folder.path(), small_plan(), make_shots()).value();
  ASSERT_NO_FATAL_FAILURE(take_until(session, 1, calibration::ShotKind::kDark));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "z00_h.png"));
  ASSERT_TRUE(session.reopen(0).has_value());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "z00_h.png"));
}

/// A fault of the virtual sensor or its stage, and the expected verdict.
struct FaultCase {
  const char* name;
  std::size_t plane;
  calibration::ShotKind kind;
  std::function<void(ShotFaults&, simulated::SensorModel)> cause;
  calibration::ShotFault fault;
};

const std::vector<FaultCase>& fault_cases() {
  using enum calibration::ShotKind;
  static const std::vector<FaultCase> kFaultCases = {
      {"Defocused", 1, kVertical,
       [](ShotFaults& faults, simulated::SensorModel sensor) {
         sensor.camera.lens.aperture_radius_mm *= 3.0;
         faults.sensor = sensor;
       },
       calibration::ShotFault::kDefocused},
      {"TooDark", 0, kVertical,
       [](ShotFaults& faults, simulated::SensorModel sensor) {
         sensor.chip.line_level *= 0.05;
         faults.sensor = sensor;
       },
       calibration::ShotFault::kTooDark},
      {"Saturated", 0, kVertical,
       [](ShotFaults& faults, simulated::SensorModel sensor) {
         sensor.chip.line_level *= 3.0;
         faults.sensor = sensor;
       },
       calibration::ShotFault::kSaturated},
      {"StrayLight", 0, kDark,
       [](ShotFaults& faults, simulated::SensorModel sensor) {
         sensor.chip.ambient_level = 0.4;
         faults.sensor = sensor;
       },
       calibration::ShotFault::kStrayLight},
      {"PlaneMoved", 1, kVerticalAgain,
       [](ShotFaults& faults, const simulated::SensorModel&) { faults.depth_error_mm = 0.05; },
       calibration::ShotFault::kPlaneMoved},
      {"WrongDepth", 3, kVertical,
       [](ShotFaults& faults, const simulated::SensorModel&) { faults.depth_error_mm = 0.3; },
       calibration::ShotFault::kWrongDepth},
      {"DotsCovered", 0, kDots,
       [](ShotFaults& faults, const simulated::SensorModel&) {
         faults.covered = {440, 320, 160, 160};
       },
       calibration::ShotFault::kMarkersHidden},
      {"LightsSwapped", 0, kVertical,
       [](ShotFaults& faults, const simulated::SensorModel&) { faults.lights_swapped = true; },
       calibration::ShotFault::kOtherPattern},
      {"LightStaysOn", 0, kDark,
       [](ShotFaults& faults, const simulated::SensorModel&) { faults.lights_stay_on = true; },
       calibration::ShotFault::kLightStaysOn}};
  return kFaultCases;
}

/// In one session, each fault occurs once and is then corrected.
TEST(GuidedSession, RefusesEachFaultWithItsReasonAndContinues) {
  const TemporaryFolder folder;
  const auto shots = make_shots();
  auto session = GuidedSession::open(folder.path(), small_plan(), shots).value();
  std::vector<FaultCase> in_order = fault_cases();
  std::stable_sort(in_order.begin(), in_order.end(), [](const FaultCase& a, const FaultCase& b) {
    return std::pair(a.plane, a.kind) < std::pair(b.plane, b.kind);
  });
  for (const FaultCase& test : in_order) {
    SCOPED_TRACE(test.name);
    ASSERT_NO_FATAL_FAILURE(take_until(session, test.plane, test.kind));
    ShotFaults faults;
    test.cause(faults, shots->sensor());
    ASSERT_TRUE(shots->set_faults(faults).has_value());
    const auto outcome = session.shoot({});
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->verdict.fault, test.fault) << outcome->verdict.finding;
    EXPECT_TRUE(session.guide().wanted()->begins_placement);
    ASSERT_TRUE(shots->set_faults({}).has_value());
  }
  ASSERT_NO_FATAL_FAILURE(take_until(session, kPlanes, calibration::ShotKind::kDark));
  EXPECT_TRUE(session.finish(Workers(2), {}).has_value());
}

}  // namespace
}  // namespace flytri::shots
