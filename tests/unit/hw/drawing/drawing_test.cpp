#include "hw/drawing/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace flytri::drawing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

cv::Vec3b at(const cv::Mat& image, int x, int y) { return image.at<cv::Vec3b>(y, x); }

Drawing some_shapes() {
  Drawing page({100.0, 60.0});
  // A box with a window, and a red disk.
  page.box({10.0, 10.0}, {30.0, 20.0}).box({20.0, 15.0}, {10.0, 10.0}).fill(kBlack);
  page.disk({70.0, 30.0}, 5.0).fill({1.0, 0.0, 0.0});
  page.line({10.0, 50.0}, {90.0, 50.0}, 1.0);
  return page;
}

TEST(Drawing, AnImageShowsWhatWasDrawnWhereItWasDrawn) {
  const auto image = some_shapes().image(4.0);
  ASSERT_TRUE(image);
  ASSERT_EQ(image->size(), cv::Size(400, 240));
  const cv::Vec3b white(255, 255, 255);
  const cv::Vec3b black(0, 0, 0);
  EXPECT_EQ(at(*image, 39, 60), white);
  EXPECT_EQ(at(*image, 40, 60), black);
  EXPECT_EQ(at(*image, 100, 80), white) << "the window";
  EXPECT_EQ(at(*image, 159, 119), black);
  EXPECT_EQ(at(*image, 280, 120), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(at(*image, 200, 200), black);
  EXPECT_EQ(at(*image, 200, 210), white);
}

TEST(Drawing, FilesHaveTheTrueSize) {
  const auto svg = some_shapes().svg();
  ASSERT_TRUE(svg);
  EXPECT_THAT(*svg, HasSubstr(R"(width="100mm" height="60mm" viewBox="0 0 100 60")"));
  const auto pdf = some_shapes().pdf();
  ASSERT_TRUE(pdf);
  EXPECT_THAT(*pdf, StartsWith("%PDF-"));
  // 100 x 60 mm in points.
  EXPECT_THAT(*pdf, HasSubstr("/MediaBox [ 0 0 283.4645"));
  EXPECT_THAT(*pdf, HasSubstr(" 170.0787"));
}

TEST(Drawing, PlacesKeepNanometers) {
  Drawing page({200.0, 200.0});
  page.box({12.345678, 100.0}, {0.014503, 10.0}).fill(kBlack);
  const auto svg = page.svg();
  ASSERT_TRUE(svg);
  // Micrometers: 1/256 µm is the finest step.
  EXPECT_THAT(*svg, HasSubstr("M 12345.6"));
  EXPECT_THAT(*svg, HasSubstr("L 12360.1"));
}

}  // namespace
}  // namespace flytri::drawing
