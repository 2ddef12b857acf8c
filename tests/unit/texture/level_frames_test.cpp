#include "core/texture/level_frames.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/texture/srgb.h"
#include "tests/support/orthographic_calibration.h"

namespace flytri::texture {
namespace {

calibration::Calibration parallel() {
  return testing::orthographic_calibration({20, 15, 15}, {640, 480}, 25.0);
}

/// A plane before the camera.
PointCloud plane() {
  PointCloud points;
  for (float x = -20.0F; x <= 20.0F; x += 0.15F) {
    for (float y = -8.0F; y <= 8.0F; y += 0.15F) {
      points.push_back({Vec3f(x, y, 0), -Vec3f::UnitZ(), {}, 0.0F});
    }
  }
  return points;
}

/// A frame that stands at x, under a lamp of this light.
TextureFrame frame_at(double x_mm, const Vec3f& light) {
  TextureFrame frame{cv::Mat(480, 640, CV_8UC3), Isometry::Identity()};
  cv::Vec3b color;
  for (int c = 0; c < 3; ++c) color[c] = srgb_from_linear(0.4F * light[c]);
  frame.image.setTo(color);
  frame.T_world_sensor.translation().x() = x_mm;
  return frame;
}

TEST(LevelFrames, AFlashThatIsNotAlwaysEquallyBrightIsLeveled) {
  const Vec3f bright(1.0F, 1.0F, 1.0F), dim(0.8F, 0.75F, 0.7F);
  std::vector<TextureFrame> frames = {frame_at(-6, bright), frame_at(0, dim), frame_at(6, bright)};
  ASSERT_TRUE(level_frames(frames, plane(), parallel(), {}, Workers(2)));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(frames[1].gain[c] / frames[0].gain[c], 1.0F / dim[c], 0.02F) << "channel " << c;
    EXPECT_NEAR(frames[2].gain[c], frames[0].gain[c], 0.01F);
  }
}

TEST(LevelFrames, FramesThatShareNothingStayAsTheyAre) {
  std::vector<TextureFrame> frames = {frame_at(-30, Vec3f::Ones()),
                                      frame_at(30, Vec3f::Constant(0.5F))};
  ASSERT_TRUE(level_frames(frames, plane(), parallel(), {}, Workers(1)));
  EXPECT_EQ(frames[0].gain, Vec3f::Ones());
  EXPECT_EQ(frames[1].gain, Vec3f::Ones());
}

TEST(LevelFrames, OneThreadAndManyGiveTheSameBits) {
  std::vector<TextureFrame> one = {frame_at(-3, Vec3f::Ones()), frame_at(3, {0.9F, 0.8F, 0.7F})};
  std::vector<TextureFrame> many = one;
  ASSERT_TRUE(level_frames(one, plane(), parallel(), {}, Workers(1)));
  ASSERT_TRUE(level_frames(many, plane(), parallel(), {}, Workers(4)));
  EXPECT_EQ(one[1].gain, many[1].gain);
}

TEST(LevelFrames, RejectsAnImageOfAnotherCamera) {
  std::vector<TextureFrame> frames = {{cv::Mat(10, 10, CV_8UC3), Isometry::Identity()}};
  const auto leveled = level_frames(frames, plane(), parallel(), {}, Workers(1));
  ASSERT_FALSE(leveled.has_value());
  EXPECT_EQ(leveled.error().code, ErrorCode::kInconsistent);
}

}  // namespace
}  // namespace flytri::texture
