#include "hw/simulated/optics/picture.h"

#include <gtest/gtest.h>

#include "core/geometry/sphere_mesh.h"
#include "tests/support/sample_meshes.h"

namespace flytri::simulated {
namespace {

PictureOptions small() {
  PictureOptions options;
  options.size = {80, 60};
  options.from_direction = Vec3(0.0, 0.0, 1.0);
  options.up = Vec3::UnitY();
  return options;
}

TEST(Picture, ShowsTheSphereInTheMiddleOfTheBackground) {
  TexturedMesh ball{sphere_mesh(Vec3(5.0, 0.0, 0.0), 2.0, 20), {}, {}};
  for (SurfacePoint& vertex : ball.mesh.vertices) vertex.color = {200, 50, 50};
  const cv::Mat image = draw_picture(ball, small(), Workers(1)).value();
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(250, 250, 252));
  const auto middle = image.at<cv::Vec3b>(30, 40);
  EXPECT_GT(middle[0], 3 * middle[1]);
}

TEST(Picture, PrefersTheAtlasToVertexColors) {
  TexturedMesh patch{
      height_field({.half_width_mm = 1.0, .step_mm = 2.0}, [](double, double) { return 0.0; }),
      {},
      cv::Mat(2, 2, CV_8UC3, cv::Scalar(0, 240, 0))};
  patch.uv.assign(patch.mesh.vertices.size(), Eigen::Vector2f(0.5F, 0.5F));
  const cv::Mat image = draw_picture(patch, small(), Workers(1)).value();
  const auto middle = image.at<cv::Vec3b>(30, 40);
  EXPECT_EQ(middle[0], 0);
  EXPECT_GT(middle[1], 100);
}

TEST(Picture, IsBitIdenticalForAnyNumberOfThreads) {
  const TexturedMesh ball{sphere_mesh(Vec3::Zero(), 2.0, 12), {}, {}};
  const cv::Mat a = draw_picture(ball, small(), Workers(1)).value();
  const cv::Mat b = draw_picture(ball, small(), Workers(2)).value();
  EXPECT_TRUE(std::equal(a.begin<cv::Vec3b>(), a.end<cv::Vec3b>(), b.begin<cv::Vec3b>()));
}

TEST(Picture, RefusesAViewAlongTheUpDirection) {
  PictureOptions options = small();
  options.up = options.from_direction;
  const TexturedMesh ball{sphere_mesh(Vec3::Zero(), 2.0, 6), {}, {}};
  EXPECT_EQ(draw_picture(ball, options, Workers(1)).error().code, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace flytri::simulated
