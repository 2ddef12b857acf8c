#include "core/live/expected_light.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/live/live_surface.h"
#include "tests/support/analytic_calibration.h"

namespace flytri::live {
namespace {

using testing::analytic_calibration;
using testing::AnalyticSensor;

const AnalyticSensor kSensor;

/// Where line n lights the plane z = z_mm, as row or column `along_px` sees it.
Vec3 lit_place(Pattern pattern, int n, double along_px, double z_mm) {
  const double across_px = kSensor.across_px(pattern, n, along_px, z_mm);
  return kSensor.back_project(to_pixel(pattern, {along_px, across_px}), z_mm);
}

TEST(ExpectedLight, NamesTheLineThatLightsAPlace) {
  const ExpectedLight light(analytic_calibration());
  for (const Pattern pattern : kPatterns) {
    for (const double z_mm : {-4.0, 0.0, 4.0}) {
      for (const int n : {1, 2}) {
        const Vec3 place = lit_place(pattern, n, 150.0, z_mm);
        const auto line = light.line_at(pattern, place, 0.1);
        ASSERT_TRUE(line) << to_string(pattern) << " line " << n << " at z = " << z_mm;
        EXPECT_EQ(line->line.value, n);
        EXPECT_NEAR(line->along_px, 150, 1);
      }
    }
  }
}

TEST(ExpectedLight, BetweenLinesAndOutsideTheVolumeThereIsNone) {
  const ExpectedLight light(analytic_calibration());
  for (const Pattern pattern : kPatterns) {
    const Vec3 between =
        0.5 * (lit_place(pattern, 1, 150.0, 0.0) + lit_place(pattern, 2, 150.0, 0.0));
    EXPECT_FALSE(light.line_at(pattern, between, 0.1));
    EXPECT_FALSE(light.line_at(pattern, lit_place(pattern, 1, 150.0, 20.0), 0.1));
  }
}

/// What the sensor at x = y = shift_mm sees of a square in the plane z = z_mm of the world.
AlignedView view_of_square(Pattern pattern, double time_s, double shift_mm, double half_mm,
                           double z_mm) {
  auto view = std::make_shared<View>();
  view->pattern = pattern;
  view->time_s = time_s;
  AlignedView aligned;
  aligned.T_world_sensor.translation() = Vec3(shift_mm, shift_mm, 0.0);
  const auto& lines = analytic_calibration().of(pattern);
  for (int n = 0; n < lines.line_count(); ++n) {
    Profile profile{LineIndex(n), lines.sheet_normals[std::size_t(n)], {}};
    for (std::size_t along = 0; along < lines.lines[std::size_t(n)].size(); ++along) {
      const Vec3 p = lit_place(pattern, n, static_cast<double>(along), z_mm);
      if ((aligned.T_world_sensor * p).head<2>().cwiseAbs().maxCoeff() > half_mm) continue;
      profile.points.push_back({p, Vec3f(0, 0, 0.01F), static_cast<float>(along)});
    }
    if (profile.points.size() >= 2) view->profiles.push_back(std::move(profile));
  }
  aligned.view = std::move(view);
  return aligned;
}

AlignedView square_view(Pattern pattern, double time_s, double shift_mm) {
  return view_of_square(pattern, time_s, shift_mm, 2.5, 0.0);
}

/// A finger in front of the square, in the way of the camera and of the light.
AlignedView finger_view(Pattern pattern, double time_s, double shift_mm) {
  return view_of_square(pattern, time_s, shift_mm, 6.0, -3.0);
}

/// The same view of nothing.
AlignedView empty_view(Pattern pattern, double time_s, double shift_mm) {
  AlignedView view = square_view(pattern, time_s, shift_mm);
  auto empty = std::make_shared<View>(*view.view);
  empty->profiles.clear();
  view.view = std::move(empty);
  return view;
}

/// A square is seen for a second, then looked for.
class MissingSquare : public ::testing::Test {
 protected:
  MissingSquare() { look(square_view, 15); }

  template <typename ViewAt>
  void look(const ViewAt& view_at, int rounds, double away_mm = 0.0) {
    for (int i = 0; i < rounds; ++i) {
      for (const Pattern pattern : kPatterns) {
        surface_.add(view_at(pattern, time_s_ += 0.033, away_mm + 0.2 * (i % 15)));
      }
    }
  }
  [[nodiscard]] std::size_t shown() const {
    const float finger_mm = -1.5F;
    const auto points = surface_.points();
    return static_cast<std::size_t>(
        std::count_if(points.begin(), points.end(),
                      [finger_mm](const auto& p) { return p.position_mm.z() > finger_mm; }));
  }

  LiveSurface surface_ = LiveSurface::create({}, analytic_calibration()).value();
  double time_s_ = 0.0;
};

TEST_F(MissingSquare, IsHiddenOnceViewsLightItAndSeeNothing) {
  const std::size_t before = shown();
  ASSERT_GT(before, 300U);
  look(empty_view, 45);
  EXPECT_LT(shown(), before / 20);
  EXPECT_EQ(surface_.crossed_count(), before - shown());
  surface_.show_crossed(true);
  EXPECT_EQ(shown(), before);
}

TEST_F(MissingSquare, IsShownAgainWhereItIsMeasuredAgain) {
  const std::size_t before = shown();
  look(empty_view, 45);
  look(square_view, 15);
  EXPECT_EQ(shown(), before);
  EXPECT_EQ(surface_.crossed_count(), 0U);
}

TEST_F(MissingSquare, StaysWhereNoLineWouldLightIt) {
  const std::size_t before = shown();
  look(empty_view, 45, 30.0);
  EXPECT_EQ(shown(), before);
}

TEST_F(MissingSquare, StaysBehindAFinger) {
  const std::size_t before = shown();
  look(finger_view, 45);
  EXPECT_GT(surface_.points().size(), before) << "the finger is seen";
  EXPECT_EQ(shown(), before);
}

TEST_F(MissingSquare, StaysIfItIsLocked) {
  const std::size_t before = shown();
  editing::EditStack edits;
  edits.push({editing::EditKind::kLock, time_s_, {{Vec3f::Zero(), -Vec3f::UnitZ(), 20.0F}}});
  surface_.set_edits(edits);
  look(empty_view, 45);
  EXPECT_EQ(shown(), before);
}

TEST(SeenLines, LeavesOutLinesThatTheCalibrationDoesNotHave) {
  View view;
  for (const int n : {1, 1000}) {
    Profile profile{LineIndex(n), Vec3::UnitX(), {}};
    profile.points.push_back({Vec3(0, 0, 2.0), Vec3f(0, 0, 0.01F), 150.0F});
    view.profiles.push_back(std::move(profile));
  }
  const SeenLines seen(view, analytic_calibration());
  EXPECT_EQ(seen.depth_mm({LineIndex(1), 150}), 2.0F);
  EXPECT_FALSE(seen.depth_mm({LineIndex(2), 150}));
  EXPECT_NO_FATAL_FAILURE(SeenLines(view, calibration::Calibration()));
}

TEST_F(MissingSquare, StaysAsLongAsItIsMeasured) {
  const std::size_t before = shown();
  look(square_view, 45);
  EXPECT_GE(shown(), before);
}

}  // namespace
}  // namespace flytri::live
