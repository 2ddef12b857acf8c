#include "hw/sheets/slide_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/read_sheet.h"

namespace flytri::sheets {
namespace {

using simulated::ProjectorModel;
using simulated::SensorModel;

struct SlideCase {
  SensorModel (*sensor)();
  Pattern pattern;
  double focal_mm;
};

class Slides : public ::testing::TestWithParam<SlideCase> {
 protected:
  const SensorModel sensor = GetParam().sensor();
  const ProjectorModel& projector = sensor.projector(GetParam().pattern);
};

/// A window of the slide at true scale.
struct Window {
  Vec2 middle_mm, size_mm;
};

/// The boxes inside the slide, in the order of x; read from the file alone.
std::vector<Window> windows_of(const SlideSheet& sheet) {
  std::vector<Window> windows;
  const Eigen::AlignedBox2d slide(Vec2(sheet.slide_mm - 0.5 * sheet.slide.size_mm),
                                  Vec2(sheet.slide_mm + 0.5 * sheet.slide.size_mm));
  for (const auto& polygon : testing::polygons_of(sheet.sheet.drawing.svg().value())) {
    Eigen::AlignedBox2d box;
    for (const Vec2& point : polygon) box.extend(point);
    if (polygon.size() != 4 || !slide.contains(box)) continue;
    windows.push_back({box.center() - sheet.slide_mm, box.sizes()});
  }
  std::sort(windows.begin(), windows.end(),
            [](const Window& a, const Window& b) { return a.middle_mm.x() < b.middle_mm.x(); });
  return windows;
}

TEST_P(Slides, LinesInTheFileAreThoseOfTheSensorWithinAMicrometer) {
  const auto sheet = slide_sheet(projector, GetParam().focal_mm);
  ASSERT_TRUE(sheet);
  const std::vector<Window> windows = windows_of(*sheet);
  ASSERT_EQ(windows.size(), projector.line_across.size());
  // The formula of the lens, written once more: 1 / focal = 1 / focus + 1 / image.
  const double image_mm = 1.0 / (1.0 / GetParam().focal_mm - 1.0 / projector.lens.focus_mm);
  constexpr double kMicron = 1e-3;
  for (std::size_t n = 0; n < windows.size(); ++n) {
    // The slide is upside down: line 0 is the last from the left.
    const Window& window = windows[windows.size() - 1 - n];
    EXPECT_NEAR(window.middle_mm.x(), -image_mm * projector.line_across[n], 0.1 * kMicron);
    EXPECT_NEAR(window.middle_mm.y(), 0.0, 0.1 * kMicron);
    EXPECT_NEAR(window.size_mm.x(), 2.0 * image_mm * projector.half_width_across, 0.1 * kMicron);
    EXPECT_NEAR(window.size_mm.y(), 2.0 * image_mm * projector.half_length_along, 0.1 * kMicron);
  }
}

/// Light through a window of the slide and the middle of the lens meets the object where the sensor
/// has this line.
TEST_P(Slides, TheLensProjectsTheWindowsToTheLinesOfTheSensor) {
  const auto sheet = slide_sheet(projector, GetParam().focal_mm);
  ASSERT_TRUE(sheet);
  const std::vector<Window> windows = windows_of(*sheet);
  const std::size_t last = windows.size() - 1;
  for (std::size_t n = 0; n < windows.size(); ++n) {
    const double x_mm = windows[last - n].middle_mm.x();
    const Vec3 through_lens = projector.direction(-x_mm / sheet->slide.distance_mm, 0.0);
    const Vec3 p_sensor = projector.center() + through_lens * projector.center().norm();
    EXPECT_NEAR(projector.slide_place(p_sensor)->x(), projector.line_across[n], 1e-6);
  }
}

TEST_P(Slides, AroundTheWindowsItIsBlack) {
  const auto sheet = slide_sheet(projector, GetParam().focal_mm);
  ASSERT_TRUE(sheet);
  constexpr double kPxPerMm = 15.0;
  const auto page = sheet->sheet.drawing.image(kPxPerMm);
  ASSERT_TRUE(page);
  const auto at = [&](const Vec2& place_mm) {
    const Vec2 px = kPxPerMm * (sheet->slide_mm + place_mm);
    return static_cast<int>(
        page->at<cv::Vec3b>(static_cast<int>(px.y()), static_cast<int>(px.x()))[0]);
  };
  const Vec2 half = 0.5 * sheet->slide.size_mm;
  EXPECT_EQ(at({half.x() - 0.5, 0.0}), 0);
  EXPECT_EQ(at({0.0, half.y() - 0.5}), 0);
  EXPECT_EQ(at({0.5 - half.x(), half.y() - 0.5}), 0);
  EXPECT_EQ(at({0.1 - half.x(), 0.1 - half.y()}), 255) << "the cut corner, above on the left";
  const auto& lines = sheet->slide.line_middle_mm;
  EXPECT_EQ(at({0.5 * (lines[0] + lines[1]), 0.0}), 0) << "between two lines";
}

INSTANTIATE_TEST_SUITE_P(
    Both, Slides,
    ::testing::Values(SlideCase{&simulated::intraoral_sensor, Pattern::kVertical, 12.0},
                      SlideCase{&simulated::intraoral_sensor, Pattern::kHorizontal, 25.0},
                      SlideCase{&simulated::face_sensor, Pattern::kVertical, 25.0},
                      SlideCase{&simulated::face_sensor, Pattern::kHorizontal, 50.0}));

TEST(Slide, ALensWithoutAnImageIsRefused) {
  const SensorModel sensor = simulated::intraoral_sensor();
  for (const double focal_mm : {0.0, -3.0, 70.0, 100.0}) {
    const auto refused = plan_slide(sensor.projector(Pattern::kVertical), focal_mm);
    ASSERT_FALSE(refused) << focal_mm;
    EXPECT_NE(refused.error().message.find("focal_mm"), std::string::npos);
  }
}

}  // namespace
}  // namespace flytri::sheets
