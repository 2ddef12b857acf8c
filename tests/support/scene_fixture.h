/// @file  A renderer in a hidden window, for tests that look at its pictures.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "tests/support/gl_context.h"
#include "ui/scene/scene_renderer.h"

namespace flytri::testing {

/// Looks along -z of the world onto its origin, nearly without perspective; 10 pixels a millimeter;
/// the background is black.
class SceneFixture : public ::testing::Test {
 protected:
  static constexpr ui::PictureSize kSize = {320, 200};
  static constexpr double kPxPerMm = 10.0;

  void SetUp() override;
  /// The picture when it no longer gets better, CV_8UC3.
  cv::Mat picture();
  /// One draw, whatever it reaches.
  cv::Mat one_picture();
  /// Where a place of the plane z = 0 is seen, px from the upper left.
  [[nodiscard]] static Vec2 pixel(double x_mm, double y_mm);

  std::unique_ptr<GlContext> context_;
  std::optional<ui::SceneRenderer> renderer_;
  ui::SceneContent content_;
  ui::SceneOptions options_;
  ui::OrbitCamera camera_{{.field_of_view_rad = 0.02}};
  double now_s_ = 0.0;
};

/// A model of one block.
[[nodiscard]] SurfelModel block_of(std::vector<Surfel> surfels, std::uint64_t place = 1);

/// A square of surfels on a grid at z = 0, facing +z, with the radius that closes it.
[[nodiscard]] std::vector<Surfel> surfel_square(double edge_mm, double spacing_mm);

/// Largest difference of two pictures in any channel, and the share of pixels where it is above
/// `limit`.
[[nodiscard]] double share_differing(const cv::Mat& a, const cv::Mat& b, int limit);

}  // namespace flytri::testing
