#include "core/texture/color_points.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/texture/srgb.h"
#include "tests/support/orthographic_calibration.h"

namespace flytri::texture {
namespace {

/// A texture camera that looks along z: U = 320 + 20 x, V = 240 + 20 y.
calibration::Calibration orthographic() {
  return testing::orthographic_calibration({20, 15, 15}, {640, 480}, 20.0);
}

SurfacePoint point_at(float x, float y, float z) {
  SurfacePoint point;
  point.position_mm = Vec3f(x, y, z);
  point.normal = -Vec3f::UnitZ();
  return point;
}

TextureFrame frame_of(const cv::Scalar& color) {
  return {cv::Mat(480, 640, CV_8UC3, color), Isometry::Identity()};
}

ColorCounts color(PointCloud& points, const std::vector<TextureFrame>& frames) {
  const auto counts = color_points(points, frames, orthographic(), {}, Workers(2));
  EXPECT_TRUE(counts.has_value());
  return *counts;
}

TEST(ColorPoints, TakesTheColorOfThePixelThatSeesThePoint) {
  TextureFrame frame = frame_of({200, 100, 50});
  frame.image.colRange(320, 640) = cv::Scalar(50, 100, 200);
  PointCloud points = {point_at(-5, 0, 0), point_at(5, 0, 0)};
  EXPECT_EQ(color(points, {frame}).observed, 2U);
  EXPECT_EQ(points[0].color, (Rgb{200, 100, 50}));
  EXPECT_EQ(points[1].color, (Rgb{50, 100, 200}));
}

TEST(ColorPoints, HiddenPointsAreNotColored) {
  TextureFrame frame = frame_of({10, 200, 10});
  PointCloud points = {point_at(0, 0, -3), point_at(0.01F, 0, 3)};
  TextureOptions options;
  options.extend_share = 0.0;
  const auto counts = color_points(points, std::vector{frame}, orthographic(), options, Workers(1));
  EXPECT_EQ(counts->observed, 1U);
  EXPECT_EQ(points[0].color, (Rgb{10, 200, 10}));
  EXPECT_EQ(points[1].color, kUntexturedColor);
}

TEST(ColorPoints, AFrameColorsOnlyWhereItServes) {
  TextureFrame old = frame_of({10, 200, 10});
  old.serves = [](const Vec3f& position_mm, const Vec3f&) { return position_mm.x() < 0.0F; };
  PointCloud points = {point_at(-5, 0, 0), point_at(5, 0, 0)};
  color(points, {old, frame_of({200, 10, 10})});
  EXPECT_NE(points[0].color, (Rgb{200, 10, 10}));
  EXPECT_EQ(points[1].color, (Rgb{200, 10, 10}));
}

TEST(ColorPoints, AHighlightGivesWayToAnotherFrame) {
  PointCloud points = {point_at(0, 0, 0)};
  color(points, {frame_of({120, 60, 30}), frame_of({220, 200, 190})});
  EXPECT_NEAR(points[0].color[0], 120, 4);
  EXPECT_NEAR(points[0].color[2], 30, 4);
}

TEST(ColorPoints, TheLightOfTheFlashIsTakenOut) {
  calibration::Calibration calibration = orthographic();
  calibration.flash = calibration::Flash{{0, 0, -100}, {0.5, 0.4, 0.25}, 0.0, {}};
  PointCloud points = {point_at(0, 0, 0), point_at(0, 0, 0)};
  points[1].normal = Vec3f(0.6F, 0, -0.8F);  // gets 0.8 of the light
  TextureFrame frame = frame_of(0);
  Rgb lit;
  for (int c = 0; c < 3; ++c) {
    lit[static_cast<std::size_t>(c)] =
        srgb_from_linear(0.5F * static_cast<float>(calibration.flash->light[c]));
  }
  frame.image.setTo(cv::Vec3b(lit[0], lit[1], lit[2]));
  const auto counts = color_points(points, std::vector{frame}, calibration, {}, Workers(1));
  ASSERT_TRUE(counts.has_value());
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(points[0].color[c], srgb_from_linear(0.5F), 2);
    EXPECT_NEAR(points[1].color[c], srgb_from_linear(0.5F / 0.8F), 2);
  }
}

TEST(ColorPoints, TheGainOfAFrameIsApplied) {
  PointCloud points = {point_at(0, 0, 0)};
  TextureFrame frame = frame_of({100, 100, 100});
  frame.gain = Vec3f(1.0F, 2.0F, 0.5F);
  color(points, {frame});
  const float light = linear_from_srgb(100);
  EXPECT_NEAR(points[0].color[0], 100, 1);
  EXPECT_NEAR(points[0].color[1], srgb_from_linear(2.0F * light), 1);
  EXPECT_NEAR(points[0].color[2], srgb_from_linear(0.5F * light), 1);
}

/// Two frames whose colors differ meet in the middle of a surface: nothing jumps at their borders.
TEST(ColorPoints, NoLineCanBeSeenWhereAFrameEnds) {
  PointCloud points;
  for (float x = -15.0F; x <= 15.0F; x += 0.05F) points.push_back(point_at(x, 0, 0));
  TextureFrame left = frame_of({150, 150, 150}), right = frame_of({160, 160, 160});
  left.T_world_sensor.translation().x() = -5.0;
  right.T_world_sensor.translation().x() = 5.0;
  color(points, {left, right});
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LE(std::abs(points[i].color[0] - points[i - 1].color[0]), 2) << "point " << i;
  }
  EXPECT_EQ(points.front().color[0], 150);
  EXPECT_EQ(points.back().color[0], 160);
}

TEST(ColorPoints, IgnoresSaturatedPixels) {
  PointCloud points = {point_at(0, 0, 0)};
  color(points, {frame_of({255, 255, 255}), frame_of({120, 60, 30})});
  EXPECT_EQ(points[0].color, (Rgb{120, 60, 30}));
}

TEST(ColorPoints, UnobservedPointsTakeTheColorOfTheirNeighbors) {
  PointCloud points = {point_at(0, 0, 0), point_at(0.5F, 0, 0), point_at(0, 0, 40)};
  points[1].normal = Vec3f::UnitX();  // turned away
  const ColorCounts counts = color(points, {frame_of({120, 60, 30})});
  EXPECT_EQ(counts.observed, 1U);
  EXPECT_EQ(counts.extended, 1U);
  EXPECT_EQ(counts.untextured, 1U);
  EXPECT_EQ(points[1].color, points[0].color);
}

TEST(ColorPoints, RejectsAnImageOfAnotherCamera) {
  PointCloud points = {point_at(0, 0, 0)};
  const TextureFrame small{cv::Mat(10, 10, CV_8UC3), Isometry::Identity()};
  const auto counts = color_points(points, std::vector{small}, orthographic(), {}, Workers(1));
  ASSERT_FALSE(counts.has_value());
  EXPECT_EQ(counts.error().code, ErrorCode::kInconsistent);
}

}  // namespace
}  // namespace flytri::texture
