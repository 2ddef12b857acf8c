#include "core/refinement/refine.h"

#include <gtest/gtest.h>

#include "core/geometry/decompositions.h"
#include "core/refinement/reduced_system.h"
#include "tests/support/moved_light.h"
#include "tests/support/scan_scene.h"

namespace flytri::refinement {
namespace {

using testing::displacement_rms_mm;
using testing::scan_cusps;
using testing::SceneSensor;
using testing::with_drift;

constexpr int kViews = 40;

Refinement refine(std::vector<AlignedView>& views, int threads = 2) {
  auto result = refine_jointly(views, {}, Workers(threads), {});
  EXPECT_TRUE(result.has_value());
  return *result;
}

TEST(RefineJointly, ReducesADriftOf300MicrometersToTheNoiseLimit) {
  const auto truth = scan_cusps(kViews, SceneSensor{}, 1).views;
  auto views = with_drift(truth, 0.3, 2);
  const double before_mm = displacement_rms_mm(views, truth);
  ASSERT_GT(before_mm, 0.08);
  refine(views);
  // 40 views of 4,500 points with 30 µm of noise. The gauge of the first view includes the error of
  // its pose (about 6 µm at its border).
  EXPECT_LT(displacement_rms_mm(views, truth), 0.015);
}

TEST(RefineJointly, IdealDataStaysAtTheTruth) {
  SceneSensor sensor;
  sensor.noise_mm = 1e-6;
  const auto truth = scan_cusps(kViews, sensor, 3).views;
  auto views = truth;
  refine(views);
  // The error of a quadric at cusps within a cell of 0.5 mm.
  EXPECT_LT(displacement_rms_mm(views, truth), 0.003);
}

TEST(RefineJointly, NoiseCausesNoBias) {
  const auto truth = scan_cusps(kViews, SceneSensor{}, 4).views;
  auto once = truth;
  refine(once);
  auto twice = once;
  refine(twice);
  EXPECT_LT(displacement_rms_mm(once, truth), 0.015);
  // A biased estimator would move further in each step; this one varies only because data change
  // cells.
  EXPECT_LT(displacement_rms_mm(twice, once), 0.008);
}

/// Edits and measurements lie in the world of the scan.
TEST(RefineJointly, DoesNotMoveTheSurfaceAsAWhole) {
  const auto truth = scan_cusps(10, SceneSensor{}, 5).views;
  // A weak first view: it shows a tenth of what the others show.
  auto before = with_drift(truth, 0.1, 6);
  View first = *before[0].view;
  for (Profile& profile : first.profiles) profile.points.resize(profile.points.size() / 10);
  before[0].view = std::make_shared<View>(first);
  auto views = before;
  refine(views);
  const Isometry T_before_after =
      best_motion(testing::placed_points_mm(views), testing::placed_points_mm(before));
  EXPECT_LT(T_before_after.translation().norm(), 5e-3);
  EXPECT_LT(Eigen::AngleAxisd(T_before_after.linear()).angle(), 5e-4);
}

TEST(RefineJointly, OneThreadAndManyGiveTheSameBits) {
  const auto truth = scan_cusps(12, SceneSensor{}, 7).views;
  auto one = with_drift(truth, 0.1, 8);
  auto many = one;
  refine(one, 1);
  refine(many, 4);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].T_world_sensor.matrix(), many[i].T_world_sensor.matrix());
  }
}

TEST(RefineJointly, ReportsAViewThatContradictsTheOthers) {
  const auto truth = scan_cusps(kViews, SceneSensor{}, 9).views;
  auto views = truth;
  // A view of another place, inserted as a view of this place.
  View foreign = *views[20].view;
  for (Profile& profile : foreign.profiles) {
    for (ProfilePoint& point : profile.points) point.position_mm.z() *= -1.0;
  }
  views[20].view = std::make_shared<View>(foreign);
  const JointRefineOptions options;
  const Refinement result = refine(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(result.contradicts(i, options), i == 20) << "view " << i;
  }
}

TEST(RefineJointly, KeepsTheBestPosesWhenCanceled) {
  const auto truth = scan_cusps(kViews, SceneSensor{}, 1).views;
  auto views = with_drift(truth, 0.3, 2);
  const double before_mm = displacement_rms_mm(views, truth);
  Progress progress;
  // After a few of its steps.
  progress = Progress([&progress](const auto& now) {
    if (now.fraction > 0.75) progress.cancel();
  });
  progress.begin_stage("aligning");
  const auto refined = refine_jointly(views, {}, Workers(2), progress);
  ASSERT_FALSE(refined.has_value());
  EXPECT_EQ(refined.error().code, ErrorCode::kCancelled);
  EXPECT_LT(displacement_rms_mm(views, truth), 0.3 * before_mm);
}

TEST(RefineJointly, RejectsOptionsOutOfRange) {
  auto views = scan_cusps(2, SceneSensor{}, 10).views;
  JointRefineOptions options;
  options.max_steps = 0;
  const auto result = refine_jointly(views, options, Workers(1), {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kBadOption);
  EXPECT_NE(result.error().message.find("max_steps"), std::string::npos);
}

TEST(RefineWithProjectors, PutsPointsWhereTheMovedLightShowsThem) {
  const auto truth = testing::with_tilted_sheets(scan_cusps(60, SceneSensor{}, 11).views);
  const ProjectorMotion moved = testing::bump(Pattern::kVertical, 0.5);
  auto without = testing::misled(truth, moved);
  auto with = without;
  std::vector<ProjectorMotion> motions = {moved, moved};
  motions[0].motion.setZero();
  motions[1].motion.setZero();
  motions[1].pattern = Pattern::kHorizontal;
  ASSERT_TRUE(refine_jointly(without, {}, Workers(2), {}));
  ASSERT_TRUE(refine_with_projectors(with, motions, testing::kCameraCenter_mm, {}, Workers(2), {}));
  EXPECT_GT(displacement_rms_mm(without, truth), 0.03);
  EXPECT_LT(displacement_rms_mm(with, truth), 0.015);
  EXPECT_LT(motions[1].motion.tail<3>().norm(), 0.005);
}

TEST(RefineWithProjectors, GoodSensorsStayAsTheyAre) {
  const auto truth = testing::with_tilted_sheets(scan_cusps(60, SceneSensor{}, 12).views);
  auto views = truth;
  std::vector<ProjectorMotion> motions = {testing::bump(Pattern::kVertical, 0.5)};
  motions[0].motion.setZero();
  ASSERT_TRUE(
      refine_with_projectors(views, motions, testing::kCameraCenter_mm, {}, Workers(2), {}));
  EXPECT_LT(displacement_rms_mm(views, truth), 0.015);
}

/// A system of random cells and views that satisfies M M^T <= D, as after the elimination of
/// surfaces.
ReducedSystem random_system(int view_count, Random& random) {
  std::vector<Vec3> centers;
  for (int v = 0; v < view_count; ++v) centers.emplace_back(v, random.normal(), random.normal());
  ReducedSystem system(centers);
  const auto random_matrix = [&] {
    Matrix6 m;
    for (int i = 0; i < 36; ++i) m(i) = random.normal();
    return m;
  };
  for (int v = 0; v + 2 < view_count; ++v) {
    std::vector<CellViewBlock> blocks;
    for (int k = 0; k < 3; ++k) {
      blocks.push_back({static_cast<std::uint32_t>(v + k), 0.3 * random_matrix()});
      const Matrix6 root = random_matrix();
      system.add_view(v + k,
                      3.0 * blocks.back().coupling * blocks.back().coupling.transpose() +
                          root * root.transpose(),
                      Twist::Constant(random.normal()));
    }
    for (const CellViewBlock& block : blocks) system.add_block(block);
    system.end_cell();
  }
  return system;
}

TEST(ReducedSystem, SolutionSatisfiesTheNormalEquations) {
  Random random(11);
  constexpr int kCount = 150;
  const Workers workers(2);
  ReducedSystem system = random_system(kCount, random);
  system.finish(workers);
  const Eigen::VectorXd x = *system.solve(workers);
  // H x must equal -g, within the tolerance of the conjugate gradients.
  Eigen::VectorXd y = system.apply(x, workers);
  EXPECT_GT(x.norm(), 0.0);
  EXPECT_LT((system.gradient() + y).norm(), 1e-4 * system.gradient().norm());
}

TEST(RefineByMetaviews, ReducesADrift) {
  const auto truth = scan_cusps(kViews, SceneSensor{}, 1).views;
  auto views = with_drift(truth, 0.3, 2);
  const double before_mm = displacement_rms_mm(views, truth);
  const auto refined = refine_by_metaviews(views, {}, {});
  ASSERT_TRUE(refined.has_value());
  EXPECT_LT(displacement_rms_mm(views, truth), 0.25 * before_mm);
  EXPECT_TRUE(views[0].T_world_sensor.isApprox(truth[0].T_world_sensor, 1e-9));
  // Each round moves the views less.
  EXPECT_LT(refined->moved_mm.back(), 0.1 * refined->moved_mm.front());
}

TEST(RefineByMetaviews, ReportsThatNothingOverlaps) {
  auto views = scan_cusps(2, SceneSensor{}, 1).views;
  views[1].T_world_sensor.translation().x() += 500.0;
  const auto refined = refine_by_metaviews(views, {}, {});
  ASSERT_TRUE(refined.has_value());
  EXPECT_EQ(refined->outcome, RefineOutcome::kNoOverlap);
}

TEST(RefineByMetaviews, ChangesNothingWhenCanceled) {
  const auto truth = scan_cusps(5, SceneSensor{}, 1).views;
  auto views = truth;
  const Progress progress;
  progress.cancel();
  const auto refined = refine_by_metaviews(views, {}, progress);
  ASSERT_FALSE(refined.has_value());
  EXPECT_EQ(refined.error().code, ErrorCode::kCancelled);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].T_world_sensor.matrix(), truth[i].T_world_sensor.matrix());
  }
}

}  // namespace
}  // namespace flytri::refinement
