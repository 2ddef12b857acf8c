#include "core/meshing/widest_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace flytri::meshing {
namespace {

constexpr double kPixel_mm = 0.02;

/// An arbitrary pose: the width must not depend on the position of the line.
Vec3 placed(double x_mm, double y_mm, double z_mm = 0.0) {
  static const Isometry T = Eigen::Translation3d(7.0, -3.0, 11.0) *
                            Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized());
  return T * Vec3(x_mm, y_mm, z_mm);
}
Vec3 up() { return placed(0.0, 0.0, 1.0) - placed(0.0, 0.0, 0.0); }

/// A circle with teeth: its radius varies by a depth, once per tooth.
std::vector<Vec3> ragged_circle(double radius_mm, double depth_mm, int teeth) {
  constexpr int kCorners = 1440;
  std::vector<Vec3> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const double radius = radius_mm + depth_mm * (1.0 - std::cos(teeth * angle)) / 2.0;
    rim.push_back(placed(radius * std::cos(angle), radius * std::sin(angle)));
  }
  return rim;
}

TEST(WidestPlace, OfACircleIsItsDiameter) {
  const WidestPlace widest = widest_place(ragged_circle(1.0, 0.0, 0), {}, up());
  EXPECT_NEAR(widest.width_mm, 2.0, 2.0 * kPixel_mm);
  EXPECT_LT((widest.center_mm - placed(0.0, 0.0)).norm(), 2.0 * kPixel_mm);
}

TEST(WidestPlace, IgnoresTeethOfTheBoundary) {
  // The area between the teeth is too narrow to count.
  const WidestPlace widest = widest_place(ragged_circle(1.0, 1.0, 40), {}, up());
  EXPECT_NEAR(widest.width_mm, 2.0, 0.15);
}

TEST(WidestPlace, OfABandAroundAJawIsAtItsWidestPlaceNotInTheMiddleOfTheJaw) {
  constexpr int kSteps = 400;
  constexpr double kRadius_mm = 25.0, kHalf_mm = 0.5;
  // At a quarter of its length, the band is wider by half a millimeter on each side.
  const auto half_width_mm = [](int i) {
    return kHalf_mm + 0.5 * std::exp(-std::pow((i - 100) / 15.0, 2));
  };
  std::vector<Vec3> rim;
  const auto add = [&](int i, double side) {
    const double angle = std::numbers::pi * i / kSteps;
    const double radius = kRadius_mm + side * half_width_mm(i);
    rim.push_back(placed(radius * std::cos(angle), radius * std::sin(angle), 0.01 * i));
  };
  for (int i = 0; i <= kSteps; ++i) add(i, 1.0);
  for (int i = kSteps; i >= 0; --i) add(i, -1.0);
  const WidestPlace widest = widest_place(rim, {}, up());
  // Such a long line uses larger pixels.
  EXPECT_NEAR(widest.width_mm, 2.0, 0.12);
  const Vec3 bulge = placed(kRadius_mm * std::sqrt(0.5), kRadius_mm * std::sqrt(0.5), 1.0);
  EXPECT_LT((widest.center_mm - bulge).norm(), 0.5);
}

TEST(WidestPlace, WithAnIslandIsBesideIt) {
  // A tooth that is not connected to the gum: not in the middle, and higher.
  std::vector<Vec3> tooth;
  for (const auto& [x, y] : {std::pair(-0.7, -0.4), {0.1, -0.4}, {0.1, 0.4}, {-0.7, 0.4}})
    tooth.push_back(placed(x, y, 0.5));
  const std::vector<std::span<const Vec3>> islands = {tooth};
  const WidestPlace widest = widest_place(ragged_circle(1.0, 0.0, 0), islands, up());
  EXPECT_NEAR(widest.width_mm, 0.9, 0.05);
  EXPECT_LT((widest.center_mm - placed(0.55, 0.0)).norm(), 0.05);
}

TEST(WidestPlace, OfALineWithoutAreaIsZero) {
  const std::vector<Vec3> there_and_back = {placed(0.0, 0.0), placed(5.0, 0.0), placed(5.0, 1e-4)};
  const WidestPlace widest = widest_place(there_and_back, {}, up());
  EXPECT_LE(widest.width_mm, kPixel_mm);
  EXPECT_LT((widest.center_mm - placed(2.5, 0.0)).norm(), 2.6);
  EXPECT_EQ(widest_place({}, {}, up()).width_mm, 0.0);
  EXPECT_EQ(widest_place(there_and_back, {}, Vec3::Zero()).width_mm, 0.0);
  const std::vector<Vec3> point(3, placed(1.0, 2.0));
  EXPECT_EQ(widest_place(point, {}, up()).width_mm, 0.0);
}

}  // namespace
}  // namespace flytri::meshing
