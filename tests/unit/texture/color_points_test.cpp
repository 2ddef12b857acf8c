#include "core/texture/color_points.h"

#include <gtest/gtest.h>

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

TEST(ColorPoints, AveragesTheColorAndTakesTheHighestIntensity) {
  PointCloud points = {point_at(0, 0, 0)};
  // The same color, once in shadow: the intensity of the brighter pixel is kept.
  color(points, {frame_of({40, 40, 40}), frame_of({180, 180, 180})});
  EXPECT_EQ(points[0].color, (Rgb{180, 180, 180}));
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
