#include "core/trajectory/hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace flytri::trajectory {
namespace {

constexpr double kPeriod_s = 1.0 / 30.0, kViewRadius_mm = 8.0, kSigma_mm = 0.02;

/// A hand of constant velocity but for white acceleration.
class WhiteHand {
 public:
  WhiteHand(double unsteadiness_mm2_s3, std::uint64_t seed)
      : kick_mm_s_(std::sqrt(unsteadiness_mm2_s3 * kPeriod_s / kKicks)), random_(seed) {}

  Isometry next() {
    for (int kick = 0; kick < kKicks; ++kick) {
      for (int i = 0; i < 6; ++i) velocity_mm_s_[i] += kick_mm_s_ * random_.normal();
      T_world_sensor_ = registration::motion_of(kPeriod_s / kKicks * velocity_mm_s_,
                                                {T_world_sensor_.translation(), kViewRadius_mm}) *
                        T_world_sensor_;
    }
    return T_world_sensor_;
  }

 private:
  static constexpr int kKicks = 20;
  double kick_mm_s_;
  Random random_;
  Twist velocity_mm_s_ = 5.0 * Twist::Ones();
  Isometry T_world_sensor_ = Isometry::Identity();
};

/// Follows a hand whose poses are measured, but for one direction after some time.
struct Followed {
  HandMotion motion{kViewRadius_mm};
  WhiteHand hand;
  Random noise{5};
  int frame = 0;

  Twist step(const Matrix6& information) {
    const bool is_open = (information.diagonal().array() == 0.0).any();
    const Isometry T_true = hand.next();
    const double time_s = ++frame * kPeriod_s;
    const auto predicted = motion.predict(time_s, Vec3::Zero());
    Twist error = Twist::Zero();
    const registration::StepFrame at{T_true.translation(), kViewRadius_mm};
    Isometry T_found = T_true;
    if (predicted) {
      error = registration::unknowns_of(T_true * predicted->T_world_sensor.inverse(), at);
      Twist drawn;
      for (int i = 0; i < 6; ++i) drawn[i] = std::sqrt(information(i, i)) * noise.normal();
      // The most likely pose of the profiles, or of profiles and prediction.
      const Matrix6 before = inverse_of_symmetric(predicted->covariance);
      const Matrix6 all = is_open ? Matrix6(before + information) : information;
      T_found = registration::motion_of(solve_symmetric(all, information * error + drawn), at) *
                predicted->T_world_sensor;
    }
    motion.add({time_s, T_found, Vec3::Zero(), information, is_open});
    return error;
  }
};

Matrix6 information_without(int direction) {
  Twist diagonal = Twist::Constant(1.0 / (kSigma_mm * kSigma_mm));
  if (direction >= 0) diagonal[direction] = 0.0;
  return diagonal.asDiagonal();
}

TEST(HandMotion, LearnsHowSteadyTheHandIs) {
  for (const double unsteadiness : {1.0, 30.0}) {
    Followed scan{.hand = WhiteHand(unsteadiness, 3)};
    double sum = 0.0, expected = 0.0;
    for (int i = 0; i < 300; ++i) {
      const auto before = scan.motion.predict((scan.frame + 1) * kPeriod_s, Vec3::Zero());
      const Twist error = scan.step(information_without(-1));
      if (i < 100 || !before) continue;
      sum += error.squaredNorm();
      expected += before->covariance.trace();
    }
    EXPECT_NEAR(std::sqrt(sum / expected), 1.0, 0.3) << unsteadiness;
  }
}

TEST(HandMotion, AnOpenDirectionGrowsUncertainAndTheOthersDoNot) {
  constexpr int kOpen = 4;
  double errors2 = 0.0, variances = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Followed scan{.hand = WhiteHand(4.0, seed)};
    for (int i = 0; i < 100; ++i) scan.step(information_without(-1));
    const double known_mm2 = scan.motion.covariance()(kOpen, kOpen);
    for (int i = 0; i < 6; ++i) scan.step(information_without(kOpen));
    const Matrix6 covariance = scan.motion.covariance();
    EXPECT_GT(covariance(kOpen, kOpen), 4.0 * known_mm2);
    EXPECT_LT(covariance(1, 1), kSigma_mm * kSigma_mm * 1.01);
    const auto predicted = scan.motion.predict((scan.frame + 1) * kPeriod_s, Vec3::Zero());
    ASSERT_TRUE(predicted);
    const Twist error = scan.step(information_without(kOpen));
    errors2 += error[kOpen] * error[kOpen];
    variances += predicted->covariance(kOpen, kOpen);
  }
  // Forty draws: their root mean square scatters by a ninth.
  EXPECT_NEAR(std::sqrt(errors2 / variances), 1.0, 0.35);
}

TEST(HandMotion, AfterAGapNothingIsPredicted) {
  HandMotion motion(kViewRadius_mm);
  EXPECT_FALSE(motion.predict(0.0, Vec3::Zero()));
  motion.add({0.0, Isometry::Identity(), Vec3::Zero(), information_without(-1), false});
  EXPECT_TRUE(motion.predict(kPeriod_s, Vec3::Zero()));
  EXPECT_FALSE(motion.predict(1.0, Vec3::Zero()));
}

}  // namespace
}  // namespace flytri::trajectory
