/// @file  A renderer in a hidden window, for tests of its images.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "tests/support/gl_context.h"
#include "ui/scene/scene_renderer.h"

namespace flytri::testing {

/// Looks along -z at the origin of the world, nearly without perspective, with 10 pixels per
/// millimeter and a black background.
class SceneFixture : public ::testing::Test {
 protected:
  static constexpr ui::PictureSize kSize = {320, 200};
  static constexpr double kPxPerMm = 10.0;

  void SetUp() override;
  /// The image when drawing is complete, CV_8UC3.
  cv::Mat picture();
  /// The image after one draw, possibly incomplete.
  cv::Mat one_picture();
  /// Image position of a point of the plane z = 0, px from the upper left.
  [[nodiscard]] static Vec2 pixel(double x_mm, double y_mm);

  std::unique_ptr<GlContext> context_;
  std::optional<ui::SceneRenderer> renderer_;
  ui::SceneContent content_;
  ui::SceneOptions options_;
  ui::OrbitCamera camera_{{.field_of_view_rad = 0.02}};
  double now_s_ = 0.0;
};

/// A model with one block.
[[nodiscard]] SurfelModel block_of(std::vector<Surfel> surfels, std::uint64_t place = 1);

/// A square of surfels on a grid at z = 0, facing +z, with a radius that leaves no gaps.
[[nodiscard]] std::vector<Surfel> surfel_square(double edge_mm, double spacing_mm);

/// Share of the pixels whose largest difference in any channel is above `limit`.
[[nodiscard]] double share_differing(const cv::Mat& a, const cv::Mat& b, int limit);

}  // namespace flytri::testing
