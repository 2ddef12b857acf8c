#include "app/lab/chart.h"

#include <gtest/gtest.h>

#include "hw/drawing/ticks.h"

namespace flytri::lab {
namespace {

constexpr drawing::Color kRed{1.0, 0.0, 0.0};

/// How many pixels of a column of the picture are red: the curve there.
int red_rows(const cv::Mat& image, int x, int from_y, int to_y) {
  int count = 0;
  for (int y = from_y; y < to_y; ++y) count += image.at<cv::Vec3b>(y, x) == cv::Vec3b(255, 0, 0);
  return count;
}

TEST(Chart, ACurveRunsFromTheLowerLeftToTheUpperRight) {
  const Chart chart{
      "Title", "note", "x", "y", {{"curve", {{0.0, 0.0}, {10.0, 5.0}}, {}, kRed, false}}};
  const auto image = draw_chart(chart).image(4.0);
  ASSERT_TRUE(image);
  // The frame is 150 mm wide and 66 mm high, from (22, 24).
  const int middle_y = 4 * 57;
  const int left_x = 4 * 30, right_x = 4 * 165;
  EXPECT_EQ(red_rows(*image, left_x, 4 * 24, middle_y), 0);
  EXPECT_GT(red_rows(*image, left_x, middle_y, 4 * 90), 0);
  EXPECT_GT(red_rows(*image, right_x, 4 * 24, middle_y), 0);
  EXPECT_EQ(red_rows(*image, right_x, middle_y, 4 * 90), 0);
}

TEST(Chart, AnAxisHasTwoToFiveLinesAtRoundValues) {
  EXPECT_DOUBLE_EQ(drawing::tick_step(10.0), 5.0);
  EXPECT_DOUBLE_EQ(drawing::tick_step(8.0), 2.0);
  EXPECT_DOUBLE_EQ(drawing::tick_step(0.04), 0.01);
  for (double length = 0.013; length < 1e5; length *= 1.37) {
    const double lines = length / drawing::tick_step(length);
    EXPECT_GT(lines, 1.5);
    EXPECT_LE(lines, 4.0 + 1e-9);
  }
}

}  // namespace
}  // namespace flytri::lab
