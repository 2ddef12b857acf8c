#include "core/scan/live_model.h"

#include <gtest/gtest.h>

#include "tests/support/orthographic_calibration.h"

namespace flytri::scan {
namespace {

constexpr double kMaxGap_s = 0.5;
const cv::Scalar kRed(200, 50, 50), kBlue(50, 50, 200);

/// Looks down onto the middle of the plane, tilted by an angle.
Isometry T_world_sensor_tilted(double angle_rad) {
  Isometry T_world_sensor = Isometry::Identity();
  T_world_sensor.linear() =
      (Eigen::AngleAxisd(M_PI, Vec3::UnitX()) * Eigen::AngleAxisd(angle_rad, Vec3::UnitY()))
          .toRotationMatrix();
  T_world_sensor.translation() = Vec3(5, 5, 0);
  return T_world_sensor;
}

/// No point lies on the border of a cell, from where rounding could move it into another.
constexpr double kHeight_mm = 0.1;

/// Lines over a plane of 10 x 10 mm.
AlignedView plane_view(Pattern pattern, double time_s, double tilt_rad) {
  const Isometry T_world_sensor = T_world_sensor_tilted(tilt_rad);
  auto view = std::make_shared<View>();
  view->pattern = pattern;
  view->time_s = time_s;
  view->frame = FrameIndex(static_cast<std::size_t>(std::lround(10.0 * time_s)));
  for (double across = 0.13; across < 10.0; across += 0.2) {
    Profile profile{LineIndex(0), Vec3::UnitX(), {}};
    for (double along = 0.01; along < 10.0; along += 0.05) {
      const Vec3 p_world = pattern == Pattern::kVertical ? Vec3(across, along, kHeight_mm)
                                                         : Vec3(along, across, kHeight_mm);
      ProfilePoint point;
      point.position_mm = T_world_sensor.inverse() * p_world;
      point.deviation_mm = Vec3f(0, 0, 0.03F);
      profile.points.push_back(point);
    }
    view->profiles.push_back(std::move(profile));
  }
  return {view, T_world_sensor};
}

class LiveTexture : public ::testing::Test {
 protected:
  /// Two views at this time, and a texture frame between them.
  void see(double time_s, double tilt_rad, const cv::Scalar& color) {
    add(time_s, tilt_rad, color);
    work();
  }
  void add(double time_s, double tilt_rad, const cv::Scalar& color) {
    const std::vector<AlignedView> views = {
        plane_view(Pattern::kVertical, time_s, tilt_rad),
        plane_view(Pattern::kHorizontal, time_s + 0.2, tilt_rad)};
    model_.add(views);
    model_.add_texture({{}, FrameKind::kTexture, time_s + 0.1, cv::Mat(480, 640, CV_8UC3, color)});
  }
  /// Builds the surface anew from views at these times, tilted except at 0 s.
  void rebuild(const std::vector<double>& times_s) {
    std::vector<AlignedView> views;
    for (const double time_s : times_s) {
      const double tilt_rad = time_s == 0.0 ? 0.0 : 0.2;
      views.push_back(plane_view(Pattern::kVertical, time_s, tilt_rad));
      views.push_back(plane_view(Pattern::kHorizontal, time_s + 0.2, tilt_rad));
    }
    model_.begin_rebuild(views, false);
    work();
  }
  void work() {
    while (model_.has_work()) model_.continue_work();
  }
  /// Of all shown surfels; nothing if they differ.
  std::optional<Rgb> color() {
    std::optional<Rgb> color;
    for (const auto& block : model_.surface().publish()) {
      for (const Surfel& surfel : block->surfels) {
        if (color && *color != surfel.color) return std::nullopt;
        color = surfel.color;
      }
    }
    return color;
  }
  static Rgb rgb(const cv::Scalar& color) {
    return {static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
            static_cast<std::uint8_t>(color[2])};
  }

  calibration::Calibration calibration_ =
      testing::orthographic_calibration({20, 20, 20}, {640, 480}, 20.0);
  LiveModel model_ = LiveModel::create({}, calibration_, kMaxGap_s).value();
};

TEST_F(LiveTexture, AFrameThatLooksMoreSquarelyTakesThePlaceOfOneBefore) {
  see(0.0, 0.2, kRed);
  // The tilt takes 2 % of the light, which is given back.
  ASSERT_TRUE(color().has_value());
  for (const std::size_t c : {0, 1, 2}) EXPECT_NEAR((*color())[c], rgb(kRed)[c], 3);
  see(1.0, 0.0, kBlue);
  EXPECT_EQ(color(), rgb(kBlue));
  ASSERT_EQ(model_.textures().size(), 1U);
  EXPECT_EQ(model_.textures()[0].frame.time_s, 1.1);
}

TEST_F(LiveTexture, AFrameThatLooksLessSquarelyDoesNot) {
  see(0.0, 0.0, kRed);
  see(5.0, 0.2, kBlue);
  EXPECT_EQ(color(), rgb(kRed));
  EXPECT_EQ(model_.textures().size(), 1U);
}

TEST_F(LiveTexture, OfEquallyGoodFramesTheLaterOneCounts) {
  see(0.0, 0.0, kRed);
  see(5.0, 0.0, kBlue);
  EXPECT_EQ(color(), rgb(kBlue));
  EXPECT_EQ(model_.textures().size(), 1U);
}

TEST_F(LiveTexture, WhileTheHandRestsTheFrameStays) {
  see(0.0, 0.0, kRed);
  see(1.0, 0.0, kBlue);
  EXPECT_EQ(color(), rgb(kRed));
}

TEST_F(LiveTexture, UndoBringsTheColorBack) {
  see(0.0, 0.0, kRed);
  editing::EditStack edits;
  edits.push({editing::EditKind::kTrim, 0.2, {{Vec3f(5, 5, 0), Vec3f::UnitZ(), 20.0F}}});
  model_.set_edits(edits);
  EXPECT_TRUE(model_.surface().publish().empty());
  edits.undo();
  model_.set_edits(edits);
  EXPECT_EQ(color(), rgb(kRed));
}

TEST_F(LiveTexture, AFrameFromBeforeATrimColorsNothingThatIsSeenAfterIt) {
  see(0.0, 0.0, kRed);
  editing::EditStack edits;
  edits.push({editing::EditKind::kTrim, 0.2, {{Vec3f(5, 5, 0), Vec3f::UnitZ(), 20.0F}}});
  model_.set_edits(edits);
  see(5.0, 0.2, kBlue);
  // Both are kept, for undo.
  EXPECT_EQ(model_.textures().size(), 2U);
  ASSERT_TRUE(color().has_value());
  for (const std::size_t c : {0, 1, 2}) EXPECT_NEAR((*color())[c], rgb(kBlue)[c], 3);
  rebuild({0.0, 5.0});
  ASSERT_TRUE(color().has_value());
  for (const std::size_t c : {0, 1, 2}) EXPECT_NEAR((*color())[c], rgb(kBlue)[c], 3);
}

TEST_F(LiveTexture, ALockKeepsItsColor) {
  see(0.0, 0.2, kRed);
  const std::optional<Rgb> locked = color();
  editing::EditStack edits;
  edits.push({editing::EditKind::kLock, 0.2, {{Vec3f(5, 5, 0), Vec3f::UnitZ(), 20.0F}}});
  model_.set_edits(edits);
  see(5.0, 0.0, kBlue);
  ASSERT_TRUE(locked.has_value());
  EXPECT_EQ(color(), locked);
}

TEST_F(LiveTexture, ABetterFrameColorsTheSurfaceThatIsBuiltAnew) {
  see(0.0, 0.2, kRed);
  const std::vector<AlignedView> views = {plane_view(Pattern::kVertical, 0.0, 0.2),
                                          plane_view(Pattern::kHorizontal, 0.2, 0.2)};
  // Views and texture of the new surface, one after the other: a better frame comes after some.
  for (const int done : {0, 1, 2, 3}) {
    model_.begin_rebuild(views, false);
    for (int i = 0; i < done; ++i) model_.continue_work();
    ASSERT_TRUE(model_.has_work());
    const double time_s = 1.0 + 5.0 * done;
    add(time_s, 0.0, done % 2 == 0 ? kBlue : kRed);
    work();
    EXPECT_EQ(color(), rgb(done % 2 == 0 ? kBlue : kRed)) << done;
  }
}

}  // namespace
}  // namespace flytri::scan
