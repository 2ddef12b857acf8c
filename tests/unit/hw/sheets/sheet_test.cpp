#include "hw/sheets/sheet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flytri::sheets {
namespace {

TEST(Sheet, TakesTheSmallestPaper) {
  EXPECT_EQ(start_sheet("", {}, {50.0, 50.0})->paper, "A4");
  EXPECT_EQ(start_sheet("", {}, {270.0, 150.0})->paper, "A3");
  EXPECT_EQ(start_sheet("", {}, {500.0, 300.0})->paper, "A2");
  EXPECT_FALSE(start_sheet("", {}, {1200.0, 300.0}));
}

TEST(Sheet, ItsContentLiesOnThePaperAndBesideTheRulers) {
  const Vec2 content(200.0, 120.0);
  const auto sheet = start_sheet("title", {"a note"}, content);
  ASSERT_TRUE(sheet);
  const Vec2 least = sheet->middle_mm - 0.5 * content;
  const Vec2 most = sheet->middle_mm + 0.5 * content;
  EXPECT_GT(least.x(), sheet->y_ruler_mm.x() + 10.0);
  EXPECT_GT(least.y(), sheet->x_ruler_mm.y() + 8.0);
  EXPECT_LE(most.x(), sheet->drawing.size_mm().x() - 10.0 + 1e-9);
  EXPECT_LE(most.y(), sheet->drawing.size_mm().y() - 10.0 + 1e-9);
}

/// Middles of the dark places along a row of an image, px.
std::vector<double> dark_places(const cv::Mat& row) {
  std::vector<double> places;
  double sum = 0.0;
  double moment = 0.0;
  for (int i = 0; i < static_cast<int>(row.total()); ++i) {
    const double dark = 255.0 - row.at<cv::Vec3b>(i)[0];
    sum += dark;
    moment += dark * i;
    if (dark == 0.0 && sum > 0.0) {
      places.push_back(moment / sum);
      sum = moment = 0.0;
    }
  }
  return places;
}

/// A print of the wrong size must not look right: the ticks are where the numbers say.
TEST(Sheet, BothRulersHaveATickForEachMillimeter) {
  const auto sheet = start_sheet("title", {"a note"}, {200.0, 120.0});
  ASSERT_TRUE(sheet);
  constexpr double kPxPerMm = 20.0;
  const auto page = sheet->drawing.image(kPxPerMm);
  ASSERT_TRUE(page);
  // Half a millimeter beside the ruler's line there are only ticks.
  const auto first = [&](double mm) { return static_cast<int>(std::lround(kPxPerMm * mm)); };
  const int reach = first(kRuler_mm + 2.0);
  const cv::Mat x_row = (*page)(
      cv::Rect(first(sheet->x_ruler_mm.x() - 1.0), first(sheet->x_ruler_mm.y() + 0.5), reach, 1));
  const cv::Mat y_column = (*page)(
      cv::Rect(first(sheet->y_ruler_mm.x() + 0.5), first(sheet->y_ruler_mm.y() - 1.0), 1, reach));
  for (const cv::Mat& ruler : {x_row.clone(), y_column.clone()}) {
    const std::vector<double> ticks = dark_places(ruler);
    ASSERT_EQ(ticks.size(), 101U);
    for (std::size_t i = 0; i < ticks.size(); ++i)
      EXPECT_NEAR((ticks[i] - ticks[0]) / kPxPerMm, static_cast<double>(i), 0.01);
  }
}

}  // namespace
}  // namespace flytri::sheets
