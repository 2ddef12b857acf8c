#include "hw/sheets/target_sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibration/fit/number_dots.h"
#include "hw/sheets/target_field.h"
#include "hw/shots/simulated_shots.h"
#include "tests/support/read_sheet.h"

namespace flytri::sheets {
namespace {

using calibration::DotTarget;
using calibration::NumberedDot;
using simulated::SensorModel;

double farthest_mm(const SensorModel& sensor) { return shots::plan_of(sensor).z_mm.back(); }

/// The target alone, as a camera sees it.
cv::Mat cut_out(const TargetSheet& target, const cv::Mat& page, double px_per_mm) {
  const Vec2 least_px = px_per_mm * (target.sheet.middle_mm + target.least_mm);
  const Vec2 size_px = px_per_mm * (target.most_mm - target.least_mm);
  return page(cv::Rect(
      static_cast<int>(std::lround(least_px.x())), static_cast<int>(std::lround(least_px.y())),
      static_cast<int>(std::lround(size_px.x())), static_cast<int>(std::lround(size_px.y()))));
}

struct ReadTarget {
  std::size_t dots = 0;
  double largest_error_mm = 0.0;
};

/// Reads a page by the code of the calibration: numbers and places of the dots.
ReadTarget read_target(const TargetSheet& target, const DotTarget& dots, const cv::Mat& page,
                       double px_per_mm, bool dots_are_black = false) {
  // Printed light is linear: no sRGB.
  cv::Mat gray;
  cv::extractChannel(cut_out(target, page, px_per_mm), gray, 1);
  if (dots_are_black) gray = 255 - gray;
  const auto found = calibration::find_dots(calibration::linear_gray(gray));
  const auto numbered = calibration::number_dots(found, dots);
  if (!numbered) {
    ADD_FAILURE() << numbered.error().message;
    return {};
  }
  ReadTarget read{numbered->size()};
  const Vec2 cut_px = (px_per_mm * (target.sheet.middle_mm + target.least_mm)).array().round();
  for (const NumberedDot& dot : *numbered) {
    const Vec2 center_px = cut_px + Vec2(dot.center.u_px + 0.5, dot.center.v_px + 0.5);
    const Vec2 place_mm = center_px / px_per_mm - target.sheet.middle_mm;
    const double error_mm = (place_mm - dots.pitch_mm * Vec2(dot.i, dot.j)).norm();
    read.largest_error_mm = std::max(read.largest_error_mm, error_mm);
  }
  return read;
}

/// All dots of the target but the three large ones, which are not numbered.
std::size_t dot_count(const TargetSheet& target, double pitch_mm) {
  const Vec2 size = (target.most_mm - target.least_mm) / pitch_mm;
  return static_cast<std::size_t>(std::lround((size.x() - 1.0) * (size.y() - 1.0))) - 3;
}

class TargetSheets : public ::testing::TestWithParam<SensorModel (*)()> {
 protected:
  const SensorModel sensor = GetParam()();
  /// Dots are 8 pixels wide, less than in the images of the sensors.
  const double px_per_mm = 8.0 / sensor.dots.diameter_mm;

  void expect_exact(const TargetSheet& target, const cv::Mat& page) const {
    const ReadTarget read = read_target(target, sensor.dots, page, px_per_mm);
    EXPECT_EQ(read.dots, dot_count(target, sensor.dots.pitch_mm));
    EXPECT_LT(read.largest_error_mm * px_per_mm, 0.05) << "pixels";
  }
};

TEST_P(TargetSheets, TheCalibrationReadsTheDotsWhereTheyBelong) {
  const auto target = dot_sheet(sensor, farthest_mm(sensor));
  ASSERT_TRUE(target);
  const auto page = target->sheet.drawing.image(px_per_mm);
  ASSERT_TRUE(page);
  expect_exact(*target, *page);
}

TEST_P(TargetSheets, OtherProgramsShowThePdfInTheSameSize) {
  const auto target = dot_sheet(sensor, farthest_mm(sensor));
  ASSERT_TRUE(target);
  const cv::Mat page = testing::render_pdf(target->sheet.drawing.pdf().value(), px_per_mm);
  if (page.empty()) GTEST_SKIP() << "pdftoppm is not installed";
  expect_exact(*target, page);
}

TEST_P(TargetSheets, OtherProgramsShowTheSvgInTheSameSize) {
  const auto target = dot_sheet(sensor, farthest_mm(sensor));
  ASSERT_TRUE(target);
  const cv::Mat page = testing::render_svg(target->sheet.drawing.svg().value(), px_per_mm);
  if (page.empty()) GTEST_SKIP() << "rsvg-convert is not installed";
  expect_exact(*target, page);
}

TEST_P(TargetSheets, TheDotsOfTheHandBoardAreWhereTheyBelong) {
  const auto target = hand_board_sheet(sensor, farthest_mm(sensor));
  ASSERT_TRUE(target);
  const auto page = target->sheet.drawing.image(px_per_mm);
  ASSERT_TRUE(page);
  const DotTarget dots = sensor.board_dots();
  const ReadTarget read = read_target(*target, dots, *page, px_per_mm, true);
  EXPECT_EQ(read.dots, dot_count(*target, dots.pitch_mm));
  EXPECT_LT(read.largest_error_mm * px_per_mm, 0.05) << "pixels";
}

TEST_P(TargetSheets, AllFillWhatTheCameraSees) {
  const double z_mm = farthest_mm(sensor);
  const Field seen = seen_field(sensor.camera, z_mm);
  for (const auto make : {dot_sheet, board_sheet, hand_board_sheet}) {
    const auto target = make(sensor, z_mm);
    ASSERT_TRUE(target);
    EXPECT_TRUE(Field(target->least_mm, target->most_mm).contains(seen));
    const Field page(Vec2(Vec2::Zero()), target->sheet.drawing.size_mm());
    EXPECT_TRUE(page.contains(Field(Vec2(target->sheet.middle_mm + target->least_mm),
                                    Vec2(target->sheet.middle_mm + target->most_mm))));
  }
}

TEST_P(TargetSheets, TheBoardIsWhiteWhereTheCameraLooks) {
  const auto target = board_sheet(sensor, farthest_mm(sensor));
  ASSERT_TRUE(target);
  const auto page = target->sheet.drawing.image(px_per_mm);
  ASSERT_TRUE(page);
  double darkest = 0.0;
  const cv::Mat inside = cut_out(*target, *page, px_per_mm);
  // Pixels at the border show a part of the frame.
  const cv::Mat whole = inside(cv::Rect(1, 1, inside.cols - 2, inside.rows - 2)).clone();
  cv::minMaxLoc(whole.reshape(1), &darkest);
  EXPECT_EQ(darkest, 255.0);
}

INSTANTIATE_TEST_SUITE_P(Both, TargetSheets,
                         ::testing::Values(&simulated::intraoral_sensor, &simulated::face_sensor));

TEST(TargetSheet, DotsThatOverlapAreRefused) {
  SensorModel sensor = simulated::intraoral_sensor();
  sensor.dots.marker_diameter_mm = 1.2;
  const auto refused = dot_sheet(sensor, 8.0);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("marker_diameter_mm is 1.2, but must be less than"),
            std::string::npos)
      << refused.error().message;
}

TEST(TargetSheet, ATargetThatNoPaperHoldsIsRefused) {
  SensorModel sensor = simulated::face_sensor();
  sensor.volume.size_mm = {1500.0, 1500.0, 100.0};
  const auto refused = board_sheet(sensor, 50.0);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("too large for A0"), std::string::npos);
}

}  // namespace
}  // namespace flytri::sheets
