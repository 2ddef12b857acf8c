#include "hw/design/design_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hw/design/design_change.h"
#include "hw/design/design_plot.h"
#include "hw/design/design_sweep.h"
#include "hw/design/head_drawing.h"

namespace flytri::design {
namespace {

using simulated::SensorLayout;

class DesignFigure : public ::testing::TestWithParam<SensorLayout (*)()> {
 protected:
  const SensorLayout layout = GetParam()();
  const DesignFigures figures = design_figures(layout).value();
  [[nodiscard]] double nearest_mm() const {
    return layout.distance_mm - 0.5 * layout.volume_mm.z();
  }
  [[nodiscard]] double farthest_mm() const {
    return layout.distance_mm + 0.5 * layout.volume_mm.z();
  }
};

// Light section with a camera that looks straight ahead: u = f b / Z + constant.
TEST_P(DesignFigure, LinesMoveAsTriangulationSays) {
  for (const DepthFigures& at : figures.depths) {
    const double distance_mm = layout.distance_mm + at.line.z_mm;
    const double expected = layout.focal_px * layout.baseline_mm / (distance_mm * distance_mm);
    EXPECT_NEAR(at.line.motion_px_per_mm, expected, 0.02 * expected);
    EXPECT_NEAR(at.line.pixel_mm, distance_mm / layout.focal_px, 1e-4 * distance_mm);
  }
}

TEST_P(DesignFigure, UniqueAreasFollowTheSameFormula) {
  const double motion_px =
      layout.focal_px * layout.baseline_mm * (1.0 / nearest_mm() - 1.0 / farthest_mm());
  for (const Pattern pattern : kPatterns) {
    const auto i = static_cast<std::size_t>(pattern);
    const UniqueAreas& areas = figures.patterns[i].areas;
    EXPECT_NEAR(areas.motion_px, motion_px, 0.1 * motion_px);
    const double spacing_px = layout.focal_px *
                              layout.volume_mm[pattern == Pattern::kVertical ? 0 : 1] /
                              layout.line_counts[i] / layout.distance_mm;
    EXPECT_NEAR(areas.spacing_px, spacing_px, 0.03 * spacing_px);
    EXPECT_LT(areas.gap_px, areas.spacing_px - 0.9 * areas.motion_px);
  }
}

// Paper, section "Physical Optimization": the full width at half maximum covers at least 3 pixels,
// and not much more. Lines widen towards the far end.
TEST_P(DesignFigure, LinesAreAsWideAsInThePaper) {
  EXPECT_GE(figures.focus.narrowest_px, 3.0);
  EXPECT_LT(figures.focus.narrowest_px, 4.5);
  EXPECT_LT(figures.depths[0].line.width_px, figures.depths[1].line.width_px);
  EXPECT_LT(figures.depths[1].line.width_px, figures.depths[2].line.width_px);
}

TEST_P(DesignFigure, TheLimitBySpeckleIsThatOfThePaper) {
  const double sin_u = layout.camera_aperture_mm / layout.distance_mm;
  const double sin_theta = std::sin(triangulation_angle_rad(layout));
  const double contrast = make_sensor(layout).chip.speckle_contrast;
  const double limit_mm = contrast / (2.0 * std::numbers::pi) * 0.55e-3 / (sin_u * sin_theta);
  EXPECT_NEAR(figures.depths[1].speckle_limit_mm, limit_mm, 1e-3 * limit_mm);
}

TEST_P(DesignFigure, OneMoreLineOrMoreDepthWouldNotBeTellable) {
  for (const Pattern pattern : kPatterns) {
    const auto i = static_cast<std::size_t>(pattern);
    const PatternFigures& lines = figures.patterns[i];
    EXPECT_GE(lines.areas.gap_px, kLeastGap_px);
    EXPECT_GE(lines.most_lines, lines.lines);
    const auto gap_px = [&](int count) {
      SensorLayout other = layout;
      other.line_counts[i] = count;
      return unique_areas(make_sensor(other), pattern, layout.volume_mm.z()).gap_px;
    };
    EXPECT_GE(gap_px(lines.most_lines), kLeastGap_px);
    EXPECT_LT(gap_px(lines.most_lines + 1), kLeastGap_px);
    EXPECT_GE(lines.largest_depth_mm, layout.volume_mm.z());
    EXPECT_NEAR(unique_areas(make_sensor(layout), pattern, lines.largest_depth_mm).gap_px,
                kLeastGap_px, 0.01);
  }
}

TEST_P(DesignFigure, TheFocusLiesInFrontOfTheMiddle) {
  EXPECT_LT(figures.focus.least_mm, layout.focus_mm - layout.distance_mm);
  EXPECT_GT(figures.focus.most_mm, layout.focus_mm - layout.distance_mm);
  EXPECT_GT(figures.seen_share, 0.97);
}

TEST_P(DesignFigure, ALargerBaselineTradesUniquenessForDepth) {
  SensorLayout wide = layout;
  wide.baseline_mm *= 1.5;
  const DesignFigures changed = design_figures(wide).value();
  EXPECT_NEAR(figures.depths[1].line.deviation_mm / changed.depths[1].line.deviation_mm, 1.5, 0.05);
  EXPECT_LT(changed.patterns[0].areas.gap_px, figures.patterns[0].areas.gap_px);
  EXPECT_LT(changed.patterns[0].most_lines, figures.patterns[0].most_lines);
}

/// Share of the pixels of a panel that have a color like the one asked for.
bool shows_color(const cv::Mat& image, const cv::Vec3b& color) {
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (cv::norm(image.at<cv::Vec3b>(y, x), color) < 12.0) return true;
  return false;
}

TEST_P(DesignFigure, EachChangeHasACurveInEachRowOfThePlot) {
  const auto sweeps = design_sweeps(layout, 3.45);
  ASSERT_TRUE(sweeps);
  ASSERT_EQ(sweeps->size(), kKnobs.size());
  for (const Sweep& sweep : *sweeps) EXPECT_GE(sweep.points.size(), 4U);
  const auto page = design_plot("", *sweeps).image(3.0);
  ASSERT_TRUE(page);
  const cv::Vec3b curve(13, 89, 166);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const cv::Rect panel(3 * (26 + 56 * column), 3 * (26 + 42 * row), 3 * 44, 3 * 30);
      EXPECT_TRUE(shows_color((*page)(panel), curve)) << row << ", " << column;
    }
}

TEST_P(DesignFigure, TheDrawingShowsTheCameraAboveTheVolume) {
  const auto page = head_drawing("", make_sensor(layout)).image(3.0);
  ASSERT_TRUE(page);
  // Both views show the camera 100 mm above the middle of the volume.
  for (const double x_mm : {0.27 * 250.0, 0.77 * 250.0}) {
    const cv::Vec3b at = page->at<cv::Vec3b>(3 * 48, static_cast<int>(3 * x_mm));
    EXPECT_LT(cv::norm(at, cv::Vec3b(13, 89, 166)), 12.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, DesignFigure,
                         ::testing::Values(&simulated::intraoral_layout, &simulated::face_layout));

}  // namespace
}  // namespace flytri::design
