#include "app/lab/line_shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flytri::lab {
namespace {

constexpr double kMiddle_px = 60.3, kWidth_px = 5.0;

/// A Gaussian line over a halo of 20 gray values that ends on both sides at these distances.
cv::Mat image_with(double halo_left_px, double halo_right_px) {
  cv::Mat image(3, 120, CV_8UC1);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const double x = u - kMiddle_px;
      const double sigma = kWidth_px / 2.3548;
      const bool lit = x > -halo_left_px && x < halo_right_px;
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(
          10.0 + (lit ? 20.0 : 0.0) + 150.0 * std::exp(-0.5 * x * x / (sigma * sigma)));
    }
  return image;
}

localization::LineSample sample_at(double across_px) {
  localization::LineSample sample;
  sample.along_px = 1;
  sample.across_px = static_cast<float>(across_px);
  sample.width_px = 1.1F * static_cast<float>(kWidth_px);
  sample.amplitude = 150.0F;
  return sample;
}

double of(const LineShape& shape, ShapeProperty property) {
  return shape[static_cast<std::size_t>(property)];
}

LineShape shape_of(const cv::Mat& image, int away = 1) {
  return line_shape(image, Pattern::kVertical, sample_at(kMiddle_px), {kWidth_px, away}).value();
}

TEST(LineShape, ALineWithoutAHaloIsSymmetric) {
  const LineShape shape = shape_of(image_with(0.0, 0.0));
  EXPECT_NEAR(of(shape, ShapeProperty::kWidth), 1.1, 1e-6);
  EXPECT_NEAR(of(shape, ShapeProperty::kAsymmetry), 0.0, 0.005);
  EXPECT_NEAR(of(shape, ShapeProperty::kHalo), 0.0, 0.005);
  EXPECT_NEAR(of(shape, ShapeProperty::kHeight), -150.0, 1e-6);
}

TEST(LineShape, AHaloIsALevelInHeightsOfTheLine) {
  const LineShape shape = shape_of(image_with(20.0, 20.0));
  EXPECT_NEAR(of(shape, ShapeProperty::kHalo), 20.0 / 150.0, 0.01);
  EXPECT_NEAR(of(shape, ShapeProperty::kAsymmetry), 0.0, 0.005);
}

TEST(LineShape, LightAwayFromTheProjectorIsPositive) {
  const cv::Mat image = image_with(0.0, 20.0);
  EXPECT_GT(of(shape_of(image, 1), ShapeProperty::kAsymmetry), 0.05);
  EXPECT_LT(of(shape_of(image, -1), ShapeProperty::kAsymmetry), -0.05);
}

TEST(LineShape, AColumnOfHorizontalLinesIsReadLikeARow) {
  const cv::Mat image = image_with(5.0, 20.0);
  EXPECT_EQ(line_shape(image.t(), Pattern::kHorizontal, sample_at(kMiddle_px), {kWidth_px, 1}),
            shape_of(image));
}

TEST(LineShape, NoneNearTheBorder) {
  const cv::Mat image = image_with(0.0, 0.0);
  for (const double across_px : {25.0, 95.0})
    EXPECT_FALSE(line_shape(image, Pattern::kVertical, sample_at(across_px), {kWidth_px, 1}));
  EXPECT_TRUE(line_shape(image, Pattern::kVertical, sample_at(31.0), {kWidth_px, 1}));
}

}  // namespace
}  // namespace flytri::lab
