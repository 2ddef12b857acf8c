#include "core/tracking/registrar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/support/wavy_scene.h"

namespace flytri::tracking {
namespace {

using testing::SceneSensor;

/// Pose of the hand at time t in s: two slow loops with tremor.
Isometry hand_pose(double t) {
  Twist twist;
  twist << 0.15 * std::sin(0.9 * t), 0.12 * std::cos(0.7 * t), 0.4 * std::sin(0.5 * t),
      6.0 * std::sin(0.55 * t), 5.0 * std::cos(0.8 * t), 0.5 * std::sin(1.1 * t);
  twist += 0.004 * Twist::Ones() * std::sin(40.0 * t) + 0.06 * Twist::Unit(3) * std::sin(47.0 * t);
  return exp_twist(twist);
}

std::shared_ptr<const View> scene_view(int frame, const Isometry& T_world_sensor,
                                       const SceneSensor& sensor) {
  Random random(17, static_cast<std::uint64_t>(frame));
  const Pattern pattern = frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
  auto view = std::make_shared<View>(
      testing::measure_scene(testing::cusped_height, sensor, pattern, T_world_sensor, random));
  view->frame = FrameIndex(frame);
  view->time_s = frame / 30.0;
  return view;
}

struct Errors {
  double rms_mm = 0, worst_mm = 0;
  int registered = 0;
};

/// Pose errors of registered views in the first-view gauge.
Errors errors_of(const std::vector<RegisteredView>& views,
                 const std::function<Isometry(double)>& T_scene_sensor) {
  Errors errors;
  std::optional<Isometry> T_scene_world;
  for (const RegisteredView& view : views) {
    if (view.fate != ViewFate::kRegistered) continue;
    const Isometry T_scene_true = T_scene_sensor(view.view->time_s);
    if (!T_scene_world) T_scene_world = T_scene_true * view.T_world_sensor.inverse();
    const double error =
        trajectory::pose_distance_mm(T_scene_true, *T_scene_world * view.T_world_sensor, 7.0);
    errors.rms_mm += error * error;
    errors.worst_mm = std::max(errors.worst_mm, error);
    ++errors.registered;
  }
  errors.rms_mm = std::sqrt(errors.rms_mm / std::max(1, errors.registered));
  return errors;
}

TEST(Registrar, TracksAHand) {
  Registrar registrar = Registrar::create().value();
  for (int frame = 0; frame < 150; ++frame) {
    registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
  }
  const Errors errors = errors_of(registrar.finish(), hand_pose);
  EXPECT_EQ(errors.registered, 150);
  EXPECT_LT(errors.rms_mm, 0.03);
}

TEST(Registrar, ResumesAfterALoss) {
  Registrar registrar = Registrar::create().value();
  // 1 s without surface, then the sensor is back near its pose at 1 s.
  const auto pose = [](double t) {
    return t < 2.5 ? hand_pose(t) : exp_twist(Twist::Constant(0.03)) * hand_pose(t - 2.5);
  };
  std::vector<RegisteredView> added;
  for (int frame = 0; frame < 120; ++frame) {
    const double t = frame / 30.0;
    SceneSensor sensor;
    if (t > 1.5 && t < 2.5) sensor.volume_mm.z() = 0.01;
    registrar.add(scene_view(frame, pose(t), sensor));
  }
  const Errors errors = errors_of(registrar.finish(), pose);
  EXPECT_GE(errors.registered, 85);
  EXPECT_LT(errors.worst_mm, 0.1);
}

TEST(Registrar, EveryRunGivesTheSameBits) {
  const auto run = [] {
    Registrar registrar = Registrar::create().value();
    for (int frame = 0; frame < 30; ++frame) {
      registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
    }
    return registrar.finish();
  };
  const auto first = run(), second = run();
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(first[i].T_world_sensor.matrix() == second[i].T_world_sensor.matrix());
  }
}

TEST(Registrar, AnEditThatIsUndoneLeavesNoTrace) {
  const auto run = [](bool is_edited) {
    Registrar registrar = Registrar::create().value();
    for (int frame = 0; frame < 20; ++frame)
      registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
    if (is_edited) {
      editing::EditStack edits;
      edits.push({editing::EditKind::kTrim, 1.0, {{Vec3f::Zero(), -Vec3f::UnitZ(), 5.0F}}});
      const std::size_t all = registrar.serving_views().size();
      const auto points = [&] {
        std::size_t count = 0;
        for (const AlignedView& view : registrar.serving_views()) count += view.view->point_count();
        return count;
      };
      const std::size_t before = points();
      registrar.set_edits(edits.state());
      EXPECT_EQ(registrar.serving_views().size(), all);
      EXPECT_LT(points(), before - 1000);
      edits.undo();
      registrar.set_edits(edits.state());
      EXPECT_EQ(points(), before);
    }
    for (int frame = 20; frame < 40; ++frame)
      registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
    return registrar.finish();
  };
  const auto edited = run(true), not_edited = run(false);
  for (std::size_t i = 0; i < edited.size(); ++i) {
    EXPECT_EQ(edited[i].fate, ViewFate::kRegistered);
    EXPECT_TRUE(edited[i].T_world_sensor.matrix() == not_edited[i].T_world_sensor.matrix());
  }
}

TEST(Registrar, NeverResumesAtAnUnknownPlace) {
  const testing::HeightField elsewhere = [](double x, double y) {
    return testing::cusped_height(y + 41.0, 23.0 - x);
  };
  Registrar registrar = Registrar::create().value();
  for (int frame = 0; frame < 40; ++frame) {
    registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
  }
  Random random(5);
  for (int frame = 60; frame < 72; ++frame) {
    const Pattern pattern = frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
    auto view = std::make_shared<View>(
        testing::measure_scene(elsewhere, {}, pattern, hand_pose(frame / 30.0), random));
    view->time_s = frame / 30.0;
    registrar.add(view);
  }
  const std::vector<RegisteredView> views = registrar.finish();
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].fate, i < 40 ? ViewFate::kRegistered : ViewFate::kRejected) << i;
    EXPECT_EQ(views[i].reason == RejectReason::kNone, i < 40) << i;
  }
}

TEST(Registrar, StartsAtTheFirstUsableView) {
  Registrar registrar = Registrar::create().value();
  SceneSensor blind;
  blind.volume_mm.z() = 0.01;
  for (int frame = 0; frame < 25; ++frame) {
    registrar.add(scene_view(frame, hand_pose(frame / 30.0), frame < 5 ? blind : SceneSensor{}));
  }
  const std::vector<RegisteredView> views = registrar.finish();
  EXPECT_EQ(views[4].reason, RejectReason::kTooFewPoints);
  ASSERT_EQ(views[5].fate, ViewFate::kRegistered);
  EXPECT_TRUE(views[5].T_world_sensor.isApprox(Isometry::Identity(), 1e-12));
  EXPECT_EQ(errors_of(views, hand_pose).registered, 20);
}

TEST(Registrar, ProposesAPlaceThatFixesThePoseAndNotTheFlatOneWhereItWasLost) {
  const testing::HeightField flat_from_12 = [](double x, double y) {
    return x > 12.0 ? 0.0 : testing::cusped_height(x, y);
  };
  Registrar registrar = Registrar::create().value();
  int last_registered = 0;
  for (int frame = 0; frame < 110; ++frame) {
    Random random(17, static_cast<std::uint64_t>(frame));
    const Isometry T_world_sensor(Eigen::Translation3d(10.0 * frame / 30.0, 0.0, 0.0));
    auto view = std::make_shared<View>(testing::measure_scene(
        flat_from_12, {}, frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal,
        T_world_sensor, random));
    view->frame = FrameIndex(frame);
    view->time_s = frame / 30.0;
    if (registrar.add(view).fate == ViewFate::kRegistered) last_registered = frame;
  }
  EXPECT_GT(last_registered, 30);
  EXPECT_TRUE(registrar.interrupted());
  const auto proposal = registrar.proposal();
  ASSERT_TRUE(proposal);
  EXPECT_EQ(proposal->second.view->frame.value, proposal->first.view->frame.value + 1);
  EXPECT_LT(proposal->second.view->frame, FrameIndex(last_registered - 10));
  double before_mm = 0.0;
  for (const ReentryProposal& other : registrar.proposals(5)) {
    EXPECT_TRUE(std::isfinite(other.uncertainty_mm));
    if (other.second.view->frame == proposal->second.view->frame) continue;
    EXPECT_GE(other.uncertainty_mm, before_mm);
    before_mm = other.uncertainty_mm;
  }
}

TEST(Registrar, ViewsOfAFastHandAreEitherRightOrRejected) {
  // Each view overlaps the previous one by half: there is little evidence, and parallel lines may
  // pull a view to the pose of the previous view.
  for (const double haste : {4.0, 8.0, 16.0}) {
    const auto path = [&](double t) { return hand_pose(haste * t); };
    Registrar registrar = Registrar::create().value();
    for (int frame = 0; frame < 60; ++frame) {
      registrar.add(scene_view(frame, path(frame / 30.0), {}));
    }
    // Well below the height of the relief and the line spacing, which are typical errors of a wrong
    // pose.
    EXPECT_LT(errors_of(registrar.finish(), path).worst_mm, 0.3) << haste;
  }
}

TEST(Registrar, ContinuesAfterAnInterruption) {
  Registrar registrar = Registrar::create().value();
  int seen = 0;
  for (int frame = 0; frame < 130; ++frame) {
    if (frame >= 60 && frame < 72) continue;
    registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
    ++seen;
  }
  const Errors errors = errors_of(registrar.finish(), hand_pose);
  EXPECT_EQ(errors.registered, seen);
  EXPECT_LT(errors.worst_mm, 0.1);
}

TEST(Registrar, AScanWithEnoughViewsIsNeverReplaced) {
  constexpr int kBefore = 20, kAfter = 40;
  const auto elsewhere = [](double t) {
    return make_isometry(Eigen::Quaterniond::Identity(), Vec3(150.0, 60.0, 0.0)) * hand_pose(t);
  };
  for (const int settled_views : {kBefore / 2, 2 * kBefore}) {
    RegistrarOptions options;
    options.settled_views = settled_views;
    options.retried_places = 4;
    Registrar registrar = Registrar::create(options).value();
    for (int frame = 0; frame < kBefore + kAfter; ++frame) {
      const double t = frame / 30.0;
      registrar.add(scene_view(frame, frame < kBefore ? hand_pose(t) : elsewhere(t), {}));
    }
    const bool is_settled = settled_views <= kBefore;
    EXPECT_EQ(registrar.interrupted(), is_settled);
    EXPECT_EQ(registrar.aligned_views().size(), is_settled ? kBefore : kAfter);
    // After the end of a scan its world frame may change.
    int registered = 0;
    for (const RegisteredView& view : registrar.finish()) {
      registered += view.fate == ViewFate::kRegistered ? 1 : 0;
    }
    EXPECT_EQ(registered, kAfter);
  }
}

TEST(Registrar, SkippedViewsAreInterpolated) {
  RegistrarOptions options;
  options.register_every = 2;
  Registrar registrar = Registrar::create(options).value();
  for (int frame = 0; frame < 61; ++frame) {
    registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
  }
  int interpolated = 0;
  for (const RegisteredView& view : registrar.finish()) {
    if (view.fate == ViewFate::kInterpolated) ++interpolated;
  }
  EXPECT_GE(interpolated, 28);
}

TEST(Registrar, RejectsOnlyViewsWhoseTimeDoesNotRise) {
  Registrar registrar = Registrar::create().value();
  for (int frame = 0; frame < 12; ++frame) {
    auto view = std::make_shared<View>(*scene_view(frame, hand_pose(frame / 30.0), {}));
    if (frame == 7) view->time_s = 6 / 30.0;
    if (frame == 9) view->time_s = std::numeric_limits<double>::quiet_NaN();
    registrar.add(view);
  }
  const std::vector<RegisteredView> views = registrar.finish();
  EXPECT_EQ(views[7].reason, RejectReason::kTimeNotRising);
  EXPECT_EQ(views[9].reason, RejectReason::kTimeNotRising);
  EXPECT_EQ(errors_of(views, hand_pose).registered, 10);
}

TEST(Registrar, ASkippedViewIsInterpolated) {
  Registrar registrar = Registrar::create().value();
  for (int frame = 0; frame < 60; ++frame) {
    const auto view = scene_view(frame, hand_pose(frame / 30.0), SceneSensor());
    const RegisteredView taken = frame == 40 ? registrar.skip(view) : registrar.add(view);
    EXPECT_EQ(taken.fate, frame == 40 ? ViewFate::kInterpolated : ViewFate::kRegistered);
  }
  const std::vector<RegisteredView> views = registrar.finish();
  EXPECT_EQ(views[40].fate, ViewFate::kInterpolated);
  EXPECT_EQ(views[41].fate, ViewFate::kRegistered);
}

TEST(Registrar, RetiredViewsKeepTheirPoseButNotTheirPoints) {
  Registrar registrar = Registrar::create().value();
  const auto add = [&](int begin, int end) {
    for (int frame = begin; frame < end; ++frame) {
      (void)registrar.add(scene_view(frame, hand_pose(frame / 30.0), SceneSensor()));
    }
  };
  add(0, 90);
  std::vector<double> times_s;
  for (int frame = 20; frame < 50; ++frame) times_s.push_back(frame / 30.0);
  registrar.retire(times_s);
  EXPECT_EQ(registrar.aligned_views().size(), 60U);
  add(90, 120);
  const std::vector<RegisteredView> views = registrar.finish();
  ASSERT_EQ(views.size(), 120U);
  for (const RegisteredView& view : views) EXPECT_EQ(view.fate, ViewFate::kRegistered);
  EXPECT_EQ(views[30].view->point_count(), 0U);
}

TEST(Registrar, ReportsEachNewViewOnce) {
  Registrar registrar = Registrar::create().value();
  std::size_t told = 0;
  for (int frame = 0; frame < 40; ++frame) {
    (void)registrar.add(scene_view(frame, hand_pose(frame / 30.0), SceneSensor()));
    const ScanGrowth growth = registrar.take_growth();
    EXPECT_FALSE(growth.is_all);
    told += growth.added.size();
  }
  EXPECT_EQ(told, 40U);
  EXPECT_TRUE(registrar.take_growth().added.empty());
}

TEST(Registrar, AppliesBetterPosesAndMovesLaterViewsWithThem) {
  Registrar registrar = Registrar::create().value();
  for (int frame = 0; frame < 30; ++frame) {
    (void)registrar.add(scene_view(frame, hand_pose(frame / 30.0), SceneSensor()));
  }
  std::vector<AlignedView> better = registrar.aligned_views();
  const std::vector<AlignedView> before = better;
  better.resize(20);
  const Isometry T_new_world(Eigen::Translation3d(0.1, 0.0, 0.0));
  for (AlignedView& view : better) view.T_world_sensor = T_new_world * view.T_world_sensor;
  registrar.apply(better);
  const std::vector<AlignedView> after = registrar.aligned_views();
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_TRUE(after[i].T_world_sensor.isApprox(T_new_world * before[i].T_world_sensor, 1e-9));
  }
}

TEST(Registrar, ContinuesASavedScan) {
  Registrar first = Registrar::create().value();
  for (int frame = 0; frame < 60; ++frame) {
    (void)first.add(scene_view(frame, hand_pose(frame / 30.0), SceneSensor()));
  }
  Registrar second = Registrar::create().value();
  second.restore(first.aligned_views());
  int registered = 0;
  for (int frame = 60; frame < 90; ++frame) {
    const auto view = scene_view(frame, hand_pose(frame / 30.0), SceneSensor());
    registered += second.add(view).fate == ViewFate::kRegistered ? 1 : 0;
  }
  EXPECT_EQ(registered, 30);
}

/// A hand that moves at 10 mm/s along x, from x = 0 at 0 s.
Isometry straight_pose(double t) {
  const double tremor_mm = 0.06 * std::sin(47.0 * t);
  return Isometry(Eigen::Translation3d(10.0 * t, tremor_mm, 0.0));
}

TEST(Registrar, ResumesAtAnotherPlaceThanProposed) {
  // 25 mm are scanned; the proposal is near their end. The hand resumes near their start, turned
  // and closer to the surface than before.
  const Isometry T_straight_held = exp_twist((Twist() << 0, 0, 0.15, 0.5, 0.5, 1.5).finished());
  Registrar registrar = Registrar::create().value();
  for (int frame = 0; frame < 75; ++frame) {
    (void)registrar.add(scene_view(frame, straight_pose(frame / 30.0), {}));
  }
  RegisteredView back;
  // One second: users do not hold still for longer.
  for (int frame = 105; frame < 135 && back.fate != ViewFate::kRegistered; ++frame) {
    const Isometry T_world_sensor = straight_pose((frame - 105) / 30.0) * T_straight_held;
    back = registrar.add(scene_view(frame, T_world_sensor, {}));
    if (back.fate != ViewFate::kRegistered) continue;
    const Isometry T_scene_world = straight_pose(0.0);
    EXPECT_LT(
        trajectory::pose_distance_mm(T_scene_world * back.T_world_sensor, T_world_sensor, 7.0),
        0.1);
  }
  EXPECT_EQ(back.fate, ViewFate::kRegistered);
}

TEST(Registrar, IsFoundAnywhereHoweverItIsHeld) {
  // Out along x, and back 7 mm beside it.
  std::vector<AlignedView> known;
  for (int frame = 0; frame < 180; ++frame) {
    const bool is_out = frame < 90;
    const Isometry T_world_sensor(
        Eigen::Translation3d(0.3 * (is_out ? frame : 180 - frame), is_out ? 0.0 : 7.0, 0.0));
    known.push_back({scene_view(frame, T_world_sensor, {}), T_world_sensor});
  }
  // Rolled by up to half a turn, and tilted.
  const std::array<std::array<double, 3>, 5> holds = {
      {{3.1, 0.0, 5.0}, {-1.6, 0.3, 12.0}, {0.8, -0.25, 20.0}, {2.4, 0.3, 16.0}, {-2.6, 0.3, 8.0}}};
  for (const auto& [roll_rad, tilt_rad, x_mm] : holds) {
    Registrar registrar = Registrar::create().value();
    registrar.restore(known);
    int views = 0;
    RegisteredView back;
    while (back.fate != ViewFate::kRegistered && views < 30) {
      const int frame = 250 + views++;
      const Isometry T_world_sensor = Eigen::Translation3d(x_mm + 0.02 * views, 3.5, 0.0) *
                                      Eigen::AngleAxisd(tilt_rad, Vec3::UnitX()) *
                                      Isometry(Eigen::AngleAxisd(roll_rad, Vec3::UnitZ()));
      back = registrar.add(scene_view(frame, T_world_sensor, {}));
      if (back.fate != ViewFate::kRegistered) continue;
      EXPECT_LT(trajectory::pose_distance_mm(back.T_world_sensor, T_world_sensor, 7.0), 0.1)
          << roll_rad;
    }
    EXPECT_EQ(back.fate, ViewFate::kRegistered) << roll_rad;
    EXPECT_LE(views, 15) << roll_rad;
  }
}

TEST(Registrar, SaysInWhichDirectionTheSurfaceDoesNotHoldTheSensor) {
  // From y = 0 on, the waves become lower, down to a twentieth.
  const testing::HeightField flatter_from_0 = [](double x, double y) {
    const double height = y < 0.0 ? 1.0 : 0.05 + 0.95 * std::exp(-y / 3.0);
    return height * testing::cusped_height(x, y);
  };
  Registrar registrar = Registrar::create().value();
  int frame = 0;
  for (; frame < 180 && !registrar.surface_hold().is_weak; ++frame) {
    Random random(17, static_cast<std::uint64_t>(frame));
    const Isometry T_scene_sensor(Eigen::Translation3d(0.0, -16.0 + 0.3 * frame, 0.0));
    auto view = std::make_shared<View>(testing::measure_scene(
        flatter_from_0, {}, frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal,
        T_scene_sensor, random));
    view->frame = FrameIndex(frame);
    view->time_s = frame / 30.0;
    const RegisteredView registered = registrar.add(view);
    EXPECT_TRUE(frame < 20 || registered.fate == ViewFate::kRegistered) << frame;
  }
  EXPECT_GT(frame, 80) << "until then, half of the view has structure";
  ASSERT_TRUE(registrar.surface_hold().is_weak);
  const WeakDirection weak = registrar.surface_hold().direction.value();
  EXPECT_FALSE(weak.is_turn);
  EXPECT_LT(std::abs(weak.direction.z()), 0.1) << "the distance is known";
  EXPECT_NEAR(weak.center_mm.y(), 0.3 * frame, 2.0) << "relative to the first view";
}

TEST(Registrar, SaysThatTheSurfaceIsTooSmoothWhereTheSensorWasPut) {
  const testing::HeightField flat_from_5 = [](double x, double y) {
    return x > 5.0 ? 0.0 : testing::cusped_height(x, y);
  };
  const auto view_at = [&](int frame, double x_mm) {
    Random random(17, static_cast<std::uint64_t>(frame));
    const Isometry T_world_sensor(Eigen::Translation3d(x_mm, 0.0, 0.0));
    auto view = std::make_shared<View>(testing::measure_scene(
        flat_from_5, {}, frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal, T_world_sensor,
        random));
    view->frame = FrameIndex(frame);
    view->time_s = frame / 30.0;
    return AlignedView{view, T_world_sensor};
  };
  std::vector<AlignedView> known;
  for (int frame = 0; frame < 120; ++frame) known.push_back(view_at(frame, 0.3 * frame));
  Registrar registrar = Registrar::create().value();
  registrar.restore(known);
  EXPECT_FALSE(registrar.lost_sensor().T_world_sensor);
  for (int frame = 200; frame < 212; ++frame) {
    EXPECT_EQ(registrar.add(view_at(frame, 22.0).view).fate, ViewFate::kRejected);
  }
  EXPECT_TRUE(registrar.lost_sensor().T_world_sensor);
  EXPECT_TRUE(registrar.lost_sensor().is_featureless);
}

TEST(Registrar, ReportsHowCloseALostViewIsToResuming) {
  Registrar registrar = Registrar::create().value();
  EXPECT_EQ(registrar.entry_share(), 1.0);
  for (int frame = 0; frame < 60; ++frame) {
    (void)registrar.add(scene_view(frame, straight_pose(frame / 30.0), {}));
  }
  // The hand returns from 40 mm beyond the end of the scanned part.
  std::vector<double> shares;
  for (int frame = 90; frame < 270; ++frame) {
    const Isometry T_world_sensor = straight_pose(6.0 - (frame - 90) / 30.0);
    const RegisteredView view = registrar.add(scene_view(frame, T_world_sensor, {}));
    if (view.fate == ViewFate::kRegistered) break;
    shares.push_back(registrar.entry_share());
  }
  EXPECT_EQ(registrar.entry_share(), 1.0);
  ASSERT_GT(shares.size(), 60U);
  ASSERT_LT(shares.size(), 179U);
  const auto mean = [&](std::size_t begin, std::size_t end) {
    return std::accumulate(shares.begin() + static_cast<std::ptrdiff_t>(begin),
                           shares.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
           static_cast<double>(end - begin);
  };
  const std::size_t count = shares.size();
  // These waves look similar everywhere, so a wrong place also fits well.
  EXPECT_GT(mean(count - 10, count), mean(0, count / 2) + 0.05);
  EXPECT_LT(*std::max_element(shares.begin(), shares.end()), 1.0);
}

}  // namespace
}  // namespace flytri::tracking
