#include "hw/simulated/hand/hand.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/sample_jaw/sample_jaw.h"

namespace flytri::simulated {
namespace {

const RayScene& jaw_scene() {
  static const RayScene scene(
      sample_jaw::make_sample_jaw({.tooth_cell_mm = 0.5, .gum_cell_mm = 0.8}, Workers(1)).value());
  return scene;
}

SensorPath short_path(double tremor = 1.0) {
  PathOptions options;
  options.kind = PathKind::kQuadrant;
  options.duration_s = 6.0;
  options.tremor_mm *= tremor;
  options.tremor_rad *= tremor;
  return plan_path(jaw_scene(), intraoral_sensor(), options).value();
}

Hand make_hand(const HandOptions& options = {}) {
  return Hand(jaw_scene(), intraoral_sensor(), short_path(), options);
}

// Aims at a place on the other side of the jaw, from above and a little from the side.
device::HandAim far_aim() {
  const auto hit = jaw_scene().first_hit({Vec3(-20.0, 5.0, 60.0), -Vec3::UnitZ()});
  return {hit->point_mm, Vec3(0.3, 0.0, 1.0).normalized(), Vec3::UnitX()};
}

// Largest speed and rotation speed until `until_s`, in steps of 0.01 s.
struct Fastest {
  double mm_s = 0.0;
  double rad_s = 0.0;
};
Fastest watch(Hand& hand, double from_s, double until_s) {
  constexpr double kStep_s = 0.01;
  Fastest fastest;
  hand.advance(from_s);
  Isometry before = hand.T_model_sensor(from_s);
  for (int i = 1; from_s + i * kStep_s <= until_s; ++i) {
    hand.advance(from_s + i * kStep_s);
    const Isometry now = hand.T_model_sensor(from_s + i * kStep_s);
    fastest.mm_s =
        std::max(fastest.mm_s, (now.translation() - before.translation()).norm() / kStep_s);
    fastest.rad_s = std::max(fastest.rad_s, rotation_angle(before.inverse() * now) / kStep_s);
    before = now;
  }
  return fastest;
}

TEST(Hand, FollowsThePathForwardsAndBackwards) {
  const SensorPath path = short_path();
  Hand hand = make_hand();
  // The hand starts from rest, which costs half of the acceleration time.
  hand.advance(3.0);
  const Isometry off =
      path.T_model_sensor(path.start_s() + 2.8).inverse() * hand.T_model_sensor(3.0);
  // The remaining difference is one time step, about 0.1 mm at this speed.
  EXPECT_LT(off.translation().norm(), 0.3);
  Hand other = make_hand();
  watch(other, 0.0, 12.6);
  // After moving forwards and backwards, with a stop at each end, it is back at the start.
  EXPECT_LT(
      (other.T_model_sensor(12.6).translation() - path.T_model_sensor(path.start_s()).translation())
          .norm(),
      2.0);
}

TEST(Hand, MovesToThePointerAtTheSpeedOfAHand) {
  Hand hand = make_hand();
  hand.advance(1.0);
  hand.follow_pointer(far_aim());
  const Fastest fastest = watch(hand, 1.0, 7.0);
  const Isometry T_model_sensor = hand.T_model_sensor(7.0);
  // The target is on the sensor's axis, inside the volume.
  const Vec3 target = T_model_sensor.inverse() * far_aim().target_mm;
  EXPECT_LT(target.head<2>().norm(), 0.1);
  EXPECT_LT(std::abs(target.z()), 7.5);
  EXPECT_LT((T_model_sensor.linear().col(2) + far_aim().towards_sensor).norm(), 0.01);
  // Lateral and depth movement each have a limit of 20 mm/s.
  EXPECT_LT(fastest.mm_s, 20.0 * std::sqrt(2.0) + 0.1);
  EXPECT_LT(fastest.rad_s, 0.81);
  EXPECT_GT(fastest.mm_s, 10.0);
}

TEST(Hand, NothingIsInTheVolumeWhenLiftedOff) {
  Hand hand = make_hand();
  hand.advance(1.0);
  const Isometry T_model_before = hand.T_model_sensor(1.0);
  hand.take_away();
  watch(hand, 1.0, 3.0);
  const Vec3 moved = T_model_before.inverse() * hand.T_model_sensor(3.0).translation();
  // Three volume depths above the pose at the request.
  EXPECT_NEAR(moved.z(), -45.0, 0.5);
  EXPECT_LT(moved.head<2>().norm(), 0.5);
}

TEST(Hand, ReturnsToWhereItLeftThePathAndHoldsStill) {
  Hand hand = make_hand();
  hand.advance(1.0);
  const Isometry T_model_left = hand.T_model_sensor(1.0);
  hand.take_away();
  hand.advance(3.0);
  hand.follow_path();
  // The hand moves back for 0.56 s, holds still for 0.5 s, and then starts from rest.
  for (const double time_s : {3.7, 4.0}) {
    hand.advance(time_s);
    const Isometry off = T_model_left.inverse() * hand.T_model_sensor(time_s);
    EXPECT_LT(off.translation().norm(), 0.3) << time_s;
    EXPECT_LT(rotation_angle(off), 0.02) << time_s;
  }
  hand.advance(6.0);
  EXPECT_GT((T_model_left.inverse() * hand.T_model_sensor(6.0)).translation().norm(), 5.0);
}

TEST(Hand, CanBePutBackElsewhere) {
  Hand hand = make_hand();
  hand.advance(1.0);
  hand.take_away();
  hand.advance(3.0);
  hand.follow_pointer(far_aim());
  const Fastest fastest = watch(hand, 3.0, 5.0);
  const Vec3 target = hand.T_model_sensor(5.0).inverse() * far_aim().target_mm;
  EXPECT_LT(target.head<2>().norm(), 0.1);
  EXPECT_LT(std::abs(target.z()), 7.5);
  // When lifted off, the hand is six times as fast.
  EXPECT_LT(fastest.mm_s, 140.0);
}

TEST(Hand, NeverJumpsForAnySequenceOfRequests) {
  Hand hand = make_hand();
  double time_s = 0.0;
  const auto calm = [&](double duration_s, double limit_mm_s) {
    const Fastest fastest = watch(hand, time_s, time_s + duration_s);
    time_s += duration_s;
    EXPECT_LT(fastest.mm_s, limit_mm_s) << "before " << time_s << " s";
  };
  // The speeds on the path and back to the path add up.
  constexpr double kCalm_mm_s = 80.0;
  calm(0.5, kCalm_mm_s);
  hand.follow_pointer(far_aim());
  calm(0.7, kCalm_mm_s);
  hand.follow_path();
  calm(0.3, kCalm_mm_s);
  hand.follow_pointer({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero()});
  calm(0.2, kCalm_mm_s);
  hand.take_away();
  calm(0.1, 200.0);
  hand.follow_path();
  calm(2.0, 200.0);
}

TEST(Hand, EqualRequestsAtEqualTimesGiveIdenticalPoses) {
  const auto run = [] {
    Hand hand = make_hand();
    hand.advance(0.71);
    hand.follow_pointer(far_aim());
    hand.advance(1.93);
    hand.take_away();
    hand.advance(2.5);
    return hand.T_model_sensor(2.4).matrix();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace flytri::simulated
