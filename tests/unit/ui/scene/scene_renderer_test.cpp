#include "ui/scene/scene_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "tests/support/scene_fixture.h"

namespace flytri::ui {
namespace {

using flytri::testing::block_of;
using flytri::testing::SceneFixture;
using flytri::testing::share_differing;
using flytri::testing::surfel_square;

class SceneRendererTest : public SceneFixture {};

Surfel disk(const Vec3f& position_mm, const Vec3f& normal, float radius_mm) {
  Surfel s;
  s.position_mm = position_mm;
  s.normal = normal.normalized();
  s.radius_mm = radius_mm;
  return s;
}

/// Center and covariance of the pixels that are not black, weighted by brightness.
struct Blob {
  double area_px = 0.0;
  Vec2 center_px = Vec2::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
};

Blob blob_in(const cv::Mat& picture) {
  Blob blob;
  double brightest = 1.0;
  const auto green = [&](int row, int column) -> double {
    return picture.at<cv::Vec3b>(row, column)[1];
  };
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      brightest = std::max(brightest, green(row, column));
    }
  }
  const auto for_each_pixel = [&](const auto& visit) {
    for (int row = 0; row < picture.rows; ++row) {
      for (int column = 0; column < picture.cols; ++column) {
        const double weight = green(row, column) / brightest;
        if (weight > 0.0) visit(weight, Vec2(column, row));
      }
    }
  };
  for_each_pixel([&](double w, const Vec2& p) {
    blob.area_px += w;
    blob.center_px += w * p;
  });
  blob.center_px /= std::max(blob.area_px, 1.0);
  for_each_pixel([&](double w, const Vec2& p) {
    blob.covariance_px2 +=
        w / blob.area_px * (p - blob.center_px) * (p - blob.center_px).transpose();
  });
  return blob;
}

TEST_F(SceneRendererTest, ATiltedDiskIsAnEllipse) {
  for (const double tilt_rad : {0.0, 0.6, 1.1}) {
    for (const double around_rad : {0.0, 0.7, 2.0}) {
      const Vec3 normal(std::sin(tilt_rad) * std::cos(around_rad),
                        std::sin(tilt_rad) * std::sin(around_rad), std::cos(tilt_rad));
      const SurfelModel model = block_of({disk({2.0F, 1.0F, 0.0F}, normal.cast<float>(), 4.0F)});
      content_.model = &model;
      const Blob blob = blob_in(picture());
      // A filled ellipse with half axes a and b: area pi a b, variances a^2/4 and b^2/4; the axis
      // across the tilt is as long as the disk's, the other shorter by the cosine.
      const double a = 40.0, b = 40.0 * std::cos(tilt_rad);
      const Vec2 center_px = pixel(2.0, 1.0);
      EXPECT_LT((blob.center_px - center_px).norm(), 0.6) << "within half a pixel's grid";
      EXPECT_NEAR(blob.area_px, std::numbers::pi * a * b, 0.05 * std::numbers::pi * a * b)
          << "a border of a quarter of a pixel more on a half axis of 18";
      const Vec2 short_axis(std::cos(around_rad), -std::sin(around_rad));
      const Vec2 long_axis(std::sin(around_rad), std::cos(around_rad));
      EXPECT_NEAR(short_axis.dot(blob.covariance_px2 * short_axis), b * b / 4.0,
                  0.06 * b * b / 4.0);
      EXPECT_NEAR(long_axis.dot(blob.covariance_px2 * long_axis), a * a / 4.0, 0.04 * a * a / 4.0);
    }
  }
}

TEST_F(SceneRendererTest, SurfelsThatFaceAwayAreNotDrawn) {
  const SurfelModel model = block_of({disk(Vec3f::Zero(), -Vec3f::UnitZ(), 4.0F)});
  content_.model = &model;
  EXPECT_EQ(blob_in(picture()).area_px, 0.0);
}

TEST_F(SceneRendererTest, ANearerSurfaceHidesAFartherOne) {
  Surfel near = disk({0.0F, 0.0F, 2.0F}, Vec3f::UnitZ(), 3.0F);
  Surfel far = disk({0.0F, 0.0F, -2.0F}, Vec3f::UnitZ(), 6.0F);
  near.textured = far.textured = true;
  near.color = {255, 0, 0};
  far.color = {0, 0, 255};
  options_.color_mode = ColorMode::kTexture;
  for (const auto& surfels : {std::vector{near, far}, std::vector{far, near}}) {
    const SurfelModel model = block_of(surfels);
    content_.model = &model;
    const cv::Mat seen = picture();
    const auto middle = seen.at<cv::Vec3b>(100, 160), side = seen.at<cv::Vec3b>(100, 160 + 45);
    EXPECT_GT(middle[0], 5 * middle[2]) << "red before blue";
    EXPECT_GT(side[2], 5 * side[0]) << "blue beside red";
  }
}

TEST_F(SceneRendererTest, AGridOfSurfelsHasNoGaps) {
  const SurfelModel model = block_of(surfel_square(10.0, 0.25));
  content_.model = &model;
  const cv::Mat seen = picture();
  for (int row = 60; row < 140; ++row) {
    for (int column = 120; column < 200; ++column) {
      ASSERT_GT(seen.at<cv::Vec3b>(row, column)[1], 150) << column << ", " << row;
    }
  }
}

TEST_F(SceneRendererTest, AddingBlocksOneByOneGivesTheSamePicture) {
  const SurfelModel first = block_of(surfel_square(6.0, 0.2), 1);
  std::vector<Surfel> beside = surfel_square(6.0, 0.2);
  for (Surfel& s : beside) s.position_mm.x() += 5.0F;
  const SurfelModel both = {first[0], block_of(std::move(beside), 2)[0]};
  content_.model = &first;
  (void)picture();
  content_.model = &both;
  const cv::Mat grown = one_picture();
  EXPECT_FALSE(renderer_->statistics().was_full);
  EXPECT_EQ(renderer_->statistics().surfels_drawn, both[1]->surfels.size());
  camera_.orbit(1.0, 0.0, kSize);
  (void)picture();
  camera_.orbit(-1.0, 0.0, kSize);
  const cv::Mat whole = picture();
  // Where the squares overlap, which of two equal depths is seen depends on the order.
  EXPECT_LT(share_differing(grown, whole, 8), 0.002);
}

TEST_F(SceneRendererTest, TrimmedSurfelsDisappear) {
  const SurfelModel whole = block_of(surfel_square(6.0, 0.2));
  std::vector<Surfel> left = whole[0]->surfels;
  std::erase_if(left, [](const Surfel& s) { return s.position_mm.x() > 0.0F; });
  const SurfelModel half = block_of(left);
  const SurfelModel nothing;
  content_.model = &whole;
  (void)picture();
  content_.model = &half;
  const cv::Mat seen = picture();
  EXPECT_GT(seen.at<cv::Vec3b>(100, 140)[1], 150);
  EXPECT_EQ(seen.at<cv::Vec3b>(100, 180)[1], 0);
  content_.model = &nothing;
  EXPECT_EQ(blob_in(picture()).area_px, 0.0);
  EXPECT_TRUE(renderer_->model_box_mm().isEmpty());
}

TEST_F(SceneRendererTest, ARecoloredBlockShowsItsNewColor) {
  std::vector<Surfel> surfels = surfel_square(6.0, 0.2);
  const SurfelModel plain = block_of(surfels);
  for (Surfel& s : surfels) {
    s.textured = true;
    s.color = {200, 40, 40};
  }
  const SurfelModel painted = block_of(surfels);
  options_.color_mode = ColorMode::kTexture;
  content_.model = &plain;
  (void)picture();
  content_.model = &painted;
  const auto at_once = one_picture().at<cv::Vec3b>(100, 160);
  EXPECT_GT(at_once[0], 2 * at_once[2]);
}

TEST_F(SceneRendererTest, UnchangedBlocksAreNotSentAgain) {
  const SurfelModel model = block_of(surfel_square(6.0, 0.2));
  content_.model = &model;
  (void)picture();
  (void)one_picture();
  EXPECT_EQ(renderer_->statistics().uploaded_bytes, 0U);
  EXPECT_EQ(renderer_->statistics().surfels_drawn, 0U) << "nothing has changed";
}

TEST_F(SceneRendererTest, ACoarsePictureIsCloseToTheFullOneThatFollows) {
  // 160 801 surfels; aiming at 5 ms, at most a third of them is drawn while the camera moves.
  const SurfelModel model = block_of(surfel_square(16.0, 0.04));
  content_.model = &model;
  const cv::Mat full = picture();
  EXPECT_EQ(renderer_->statistics().detail_share, 1.0);
  options_.moving_frame_ms = 5.0;
  for (int i = 0; i < 20; ++i) {
    camera_.orbit(i % 2 == 0 ? 0.001 : -0.001, 0.0, kSize);
    (void)one_picture();
  }
  const cv::Mat coarse = one_picture();
  camera_.orbit(0.001, 0.0, kSize);
  const cv::Mat moving = one_picture();
  EXPECT_LT(renderer_->statistics().detail_share, 0.5);
  EXPECT_TRUE(renderer_->wants_redraw());
  EXPECT_LT(share_differing(full, moving, 12), 0.03) << "except for the border and rare gaps";
  EXPECT_LT(share_differing(full, picture(), 12), 0.002);
}

TEST_F(SceneRendererTest, PickReturnsTheSurfaceUnderThePixel) {
  // A plane tilted by 30 degrees about y through the origin.
  const Vec3 normal(-0.5, 0.0, std::sqrt(0.75));
  std::vector<Surfel> surfels = surfel_square(14.0, 0.1);
  for (Surfel& s : surfels) {
    s.position_mm.z() = static_cast<float>(-s.position_mm.x() * normal.x() / normal.z());
    s.normal = normal.cast<float>();
  }
  const SurfelModel model = block_of(surfels);
  content_.model = &model;
  (void)picture();
  for (const double x_mm : {-4.0, 0.0, 3.0}) {
    const Vec2 px = pixel(x_mm, 2.0);
    const auto pick = renderer_->pick(px.x(), px.y());
    ASSERT_TRUE(pick);
    // A splat has one depth: on a slope of 0.58, a radius of 0.085 mm is 0.05 mm off.
    EXPECT_NEAR(normal.dot(pick->p_world_mm - Vec3(0.0, 2.0, 0.0)), 0.0, 0.06);
    EXPECT_NEAR(pick->p_world_mm.x(), x_mm, 0.06);
    EXPECT_GT(pick->normal.dot(normal), std::cos(0.15));
  }
  EXPECT_FALSE(renderer_->pick(2.0, 2.0)) << "beside the model";
  EXPECT_FALSE(renderer_->pick(-5.0, 100.0)) << "outside the picture";
}

TEST_F(SceneRendererTest, LockedStrokesAreTinted) {
  const SurfelModel model = block_of(surfel_square(10.0, 0.2));
  content_.model = &model;
  const auto before = picture().at<cv::Vec3b>(100, 160);
  content_.tints.locked = {{Vec3f::Zero(), Vec3f::UnitZ(), 2.0F}};
  const cv::Mat seen = picture();
  const auto middle = seen.at<cv::Vec3b>(100, 160), beside = seen.at<cv::Vec3b>(100, 195);
  EXPECT_EQ(before, beside);
  EXPECT_LT(middle[0] + 30, before[0]) << "bluish";
  content_.tints.locked.clear();
  EXPECT_EQ(picture().at<cv::Vec3b>(100, 160), before);
}

TEST_F(SceneRendererTest, AStrokeShowsWhatItWillTrimButNotWhatIsLocked) {
  const SurfelModel model = block_of(surfel_square(10.0, 0.2));
  content_.model = &model;
  const auto before = picture().at<cv::Vec3b>(100, 160);
  content_.tints.to_trim = {{Vec3f::Zero(), Vec3f::UnitZ(), 2.0F}};
  const cv::Mat seen = picture();
  const auto middle = seen.at<cv::Vec3b>(100, 160);
  EXPECT_EQ(seen.at<cv::Vec3b>(100, 195), before);
  EXPECT_LT(middle[2] + 30, middle[0]) << "reddish";
  content_.tints.locked = content_.tints.to_trim;
  EXPECT_GT(picture().at<cv::Vec3b>(100, 160)[2], middle[0] - 30) << "bluish";
  content_.tints = {};
  EXPECT_EQ(picture().at<cv::Vec3b>(100, 160), before);
}

/// Whether a lit pixel has the color, darker or brighter.
bool hue_is(const cv::Vec3b& pixel, const Color& color) {
  // The gloss of the light is white: it takes a little from a dark color's hue.
  const Eigen::Vector3d a = Eigen::Vector3d(pixel[0], pixel[1], pixel[2]).normalized();
  return a.dot(Eigen::Vector3f(color[0], color[1], color[2]).cast<double>().normalized()) > 0.94;
}

TEST_F(SceneRendererTest, CoverageAndUncertaintyHaveTheColorsOfTheirLegends) {
  std::vector<Surfel> surfels = surfel_square(10.0, 0.2);
  for (Surfel& s : surfels) {
    if (s.position_mm.x() < 0.0F) s.coverage = Coverage::kThin;
    s.sigma_mm = s.position_mm.x() < 0.0F ? 0.03F : 0.0F;
  }
  const SurfelModel model = block_of(surfels);
  content_.model = &model;
  options_.color_mode = ColorMode::kCoverage;
  cv::Mat seen = picture();
  EXPECT_TRUE(hue_is(seen.at<cv::Vec3b>(100, 130), options_.thin_color));
  EXPECT_TRUE(hue_is(seen.at<cv::Vec3b>(100, 190), options_.good_color));
  options_.color_mode = ColorMode::kUncertainty;
  seen = picture();
  EXPECT_TRUE(hue_is(seen.at<cv::Vec3b>(100, 130), sigma_color(1.0)));
  EXPECT_TRUE(hue_is(seen.at<cv::Vec3b>(100, 190), sigma_color(0.0)));
}

TEST_F(SceneRendererTest, AMeshReplacesTheModelAndShowsItsAtlas) {
  TexturedMesh mesh;
  for (const auto& [x, y] : {std::pair(-5.0F, -5.0F), {5.0F, -5.0F}, {5.0F, 5.0F}, {-5.0F, 5.0F}}) {
    SurfacePoint vertex;
    vertex.position_mm = {x, y, 0.0F};
    mesh.mesh.vertices.push_back(vertex);
    mesh.uv.emplace_back(0.5F + 0.1F * x, 0.5F - 0.1F * y);
  }
  mesh.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.atlas = cv::Mat(4, 4, CV_8UC3, cv::Scalar(40, 40, 220));
  mesh.atlas.colRange(0, 2).setTo(cv::Scalar(220, 40, 40));
  const SurfelModel model = block_of(surfel_square(10.0, 0.2));
  content_.model = &model;
  content_.mesh = &mesh;
  options_.color_mode = ColorMode::kTexture;
  const cv::Mat seen = picture();
  const auto left = seen.at<cv::Vec3b>(100, 125), right = seen.at<cv::Vec3b>(100, 195);
  EXPECT_GT(left[0], 3 * left[2]);
  EXPECT_GT(right[2], 3 * right[0]);
  std::swap(mesh.mesh.triangles[0][0], mesh.mesh.triangles[0][1]);
  std::swap(mesh.mesh.triangles[1][0], mesh.mesh.triangles[1][1]);
  content_.mesh_number = 1;
  EXPECT_EQ(blob_in(picture()).area_px, 0.0) << "seen from behind";
}

TEST_F(SceneRendererTest, AMeshHasTheCoverageOfItsScan) {
  TexturedMesh mesh;
  for (int column = 0; column <= 10; ++column) {
    for (const float y : {-5.0F, 5.0F}) {
      SurfacePoint vertex;
      vertex.position_mm = {static_cast<float>(column - 5), y, 0.0F};
      mesh.mesh.vertices.push_back(vertex);
    }
    const auto first = static_cast<std::uint32_t>(2 * column);
    if (column == 10) continue;
    mesh.mesh.triangles.push_back({first, first + 2, first + 1});
    mesh.mesh.triangles.push_back({first + 1, first + 2, first + 3});
  }
  // Scanned well in the middle, thinly to the left, not at all to the right.
  std::vector<Surfel> surfels = surfel_square(10.0, 0.2);
  std::erase_if(surfels, [](const Surfel& s) { return s.position_mm.x() > 2.0F; });
  for (Surfel& s : surfels) {
    if (s.position_mm.x() < -2.0F) s.coverage = Coverage::kThin;
  }
  const SurfelModel model = block_of(surfels);
  content_.model = &model;
  content_.mesh = &mesh;
  options_.color_mode = ColorMode::kCoverage;
  const cv::Mat seen = picture();
  const auto hue_at = [&](double x_mm) {
    return seen.at<cv::Vec3b>(100, static_cast<int>(pixel(x_mm, 0.0).x()));
  };
  EXPECT_TRUE(hue_is(hue_at(-4.0), options_.thin_color));
  EXPECT_TRUE(hue_is(hue_at(0.0), options_.good_color));
  EXPECT_TRUE(hue_is(hue_at(4.0), options_.thin_color));
}

TEST_F(SceneRendererTest, AMeshMayBeCoarseInMotionAndIsSharpAtRest) {
  // A square of 300 x 300 vertices, to be drawn in 0 ms: impossible.
  constexpr std::uint32_t kSide = 300;
  TexturedMesh mesh;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    SurfacePoint vertex;
    vertex.position_mm = 0.04F * Vec3f(static_cast<float>(i % kSide) - 150.0F,
                                       static_cast<float>(i / kSide) - 150.0F, 0.0F);
    mesh.mesh.vertices.push_back(vertex);
    if (i % kSide + 1 == kSide || i / kSide + 1 == kSide) continue;
    mesh.mesh.triangles.push_back({i, i + 1, i + kSide});
    mesh.mesh.triangles.push_back({i + 1, i + kSide + 1, i + kSide});
  }
  content_.mesh = &mesh;
  options_.moving_frame_ms = 0.0;
  const cv::Mat still = picture();
  camera_.orbit(0.001, 0.0, kSize);
  const cv::Mat moving = one_picture();
  EXPECT_TRUE(renderer_->wants_redraw()) << "surfels stand in for the triangles";
  EXPECT_LT(share_differing(still, moving, 12), 0.03) << "except for the border";
  EXPECT_EQ(share_differing(still, picture(), 2), 0.0);
}

TEST_F(SceneRendererTest, LinesHaveTheirWidthAndAreFaintBehindTheSurface) {
  std::vector<Surfel> surfels = surfel_square(10.0, 0.1);
  std::erase_if(surfels, [](const Surfel& s) { return s.position_mm.x() > 0.0F; });
  const SurfelModel model = block_of(surfels);
  content_.model = &model;
  content_.measurements = {{Vec3(-4.0, 0.0, -3.0), Vec3(4.0, 0.0, -3.0), false}};
  const cv::Mat hidden_and_free = picture();
  content_.measurements.clear();
  const cv::Mat without = picture();
  double width_px = 0.0;  // the casing around it is black
  for (int row = 80; row < 120; ++row) {
    width_px += hidden_and_free.at<cv::Vec3b>(row, 180)[1] / 255.0;
  }
  EXPECT_NEAR(width_px, 2.5, 0.15) << "of a measured segment";
  const int there = hidden_and_free.at<cv::Vec3b>(100, 140)[1],
            before = without.at<cv::Vec3b>(100, 140)[1];
  EXPECT_GT(std::abs(there - before), 5) << "behind the surface it is seen";
  EXPECT_LT(std::abs(there - before), 60) << "faintly";
}

TEST_F(SceneRendererTest, DimmingDarkensTheModel) {
  const SurfelModel model = block_of(surfel_square(10.0, 0.2));
  content_.model = &model;
  const int before = picture().at<cv::Vec3b>(100, 160)[1];
  content_.is_dimmed = true;
  EXPECT_LT(picture().at<cv::Vec3b>(100, 160)[1], before / 2);
}

/// Pixels that differ outside of a box that counts from below.
int differing_outside(const cv::Mat& a, const cv::Mat& b, const PixelBox& box) {
  int count = 0;
  for (int row = 0; row < a.rows; ++row) {
    for (int column = 0; column < a.cols; ++column) {
      const bool differs = a.at<cv::Vec3b>(row, column) != b.at<cv::Vec3b>(row, column);
      if (differs && !box.contains(Eigen::Vector2i(column, a.rows - 1 - row))) ++count;
    }
  }
  return count;
}

/// One thing that may be different in the next picture.
void change(int what, Random& random, SceneContent& content, OrbitCamera& camera,
            const PictureSize& size) {
  const auto place = [&] {
    return Vec3(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), 1.0);
  };
  switch (what) {
    case 0:
    case 6:
      return camera.orbit(random.uniform(-15.0, 15.0), random.uniform(-15.0, 15.0), size);
    case 1:
      // Alone: the arms of a measured segment turn with the camera, which hides what does not.
      content.measurements.clear();
      content.sensors = {{Isometry(Eigen::Translation3d(place())), Vec3(4.0, 3.0, 3.0), false}};
      return;
    case 2:
      content.measurements = {{place(), place(), false}};
      return;
    case 3:
      content.is_dimmed = !content.is_dimmed;
      return;
    default:
      content.sensors.clear();
      content.measurements.clear();
  }
}

TEST_F(SceneRendererTest, UpdatesGiveThePictureOfANewRendererAndReportWhereItChanged) {
  SurfelModel model = block_of(surfel_square(4.0, 0.2), 1);
  content_.model = &model;
  options_.level_of_detail = false;
  options_.background_top = {0.3F, 0.3F, 0.4F, 1.0F};
  Random random(4);
  cv::Mat before = picture();
  for (int step = 0; step < 60; ++step) {
    const int what = static_cast<int>(random.uniform(0.0, 7.0));
    if (what == 5) {
      std::vector<Surfel> more = surfel_square(2.0, 0.2);
      const float x = static_cast<float>(random.uniform(-6.0, 6.0));
      for (Surfel& s : more) s.position_mm.x() += x;
      model.push_back(block_of(std::move(more), 2 + static_cast<std::uint64_t>(step))[0]);
    } else {
      change(what, random, content_, camera_, kSize);
    }
    const cv::Mat after = one_picture();
    EXPECT_EQ(differing_outside(before, after, renderer_->repainted_px()), 0)
        << "step " << step << ", change " << what;
    Result<SceneRenderer> fresh = SceneRenderer::create();
    ASSERT_TRUE(fresh);
    fresh->draw(content_, options_, camera_, kSize, now_s_);
    // Which of two splats of equal depth is seen depends on the order.
    ASSERT_LT(share_differing(after, fresh->picture().read(), 8), 0.002)
        << "step " << step << ", change " << what;
    before = after;
  }
}

}  // namespace
}  // namespace flytri::ui
