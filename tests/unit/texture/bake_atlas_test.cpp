#include "core/texture/bake_atlas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/evaluation/color_error.h"
#include "core/geometry/mesh_normals.h"
#include "core/texture/atlas_charts.h"
#include "core/texture/srgb.h"
#include "core/texture/texel_raster.h"
#include "tests/support/colored_sphere.h"
#include "tests/support/orthographic_calibration.h"

namespace flytri::texture {
namespace {

/// A texture camera that looks along z: U = 320 + 20 x, V = 240 + 20 y.
calibration::Calibration six_sided_calibration() {
  return testing::orthographic_calibration({20, 20, 20}, {640, 480}, 20.0);
}

/// A wavy surface that faces the camera, 10 mm wide; higher waves have steeper flanks.
TriangleMesh wave(float height_mm) {
  constexpr std::uint32_t kCount = 60;
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j < kCount; ++j) {
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const float x = 10.0F * static_cast<float>(i) / kCount - 5.0F;
      const float y = 10.0F * static_cast<float>(j) / kCount - 5.0F;
      mesh.vertices.push_back({Vec3f(x, y, height_mm * std::sin(1.5F * x)), -Vec3f::UnitZ()});
      if (i == 0 || j == 0) continue;
      const std::uint32_t v = j * kCount + i;
      mesh.triangles.push_back({v, v - kCount, v - 1});
      mesh.triangles.push_back({v - 1, v - kCount, v - kCount - 1});
    }
  }
  compute_vertex_normals(mesh);
  return mesh;
}

/// Left half red, right half blue.
TextureFrame two_colors() {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar(200, 40, 40));
  image.colRange(320, 640) = cv::Scalar(40, 40, 200);
  return {image, Isometry::Identity()};
}

TEST(AtlasCharts, EveryTriangleIsInOneChartAndNoTexelInTwoTriangles) {
  for (const TriangleMesh& mesh : {wave(0.5F), wave(4.0F), colored_sphere().mesh}) {
    ChartOptions options;
    options.texel_mm = 0.06;
    options.max_chart_px = 64;
    std::vector<Chart> charts = *cut_charts(mesh, options);
    ASSERT_TRUE(pack_charts(charts, 1024));
    std::vector<int> charts_of(mesh.triangles.size(), 0);
    std::set<std::pair<int, int>> taken;
    std::size_t texels = 0;
    for (const Chart& chart : charts) {
      EXPECT_LE(chart.size_px.maxCoeff(), options.max_chart_px);
      for (const std::uint32_t t : chart.triangles) {
        ++charts_of[t];
        std::array<Eigen::Array2f, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
          corners[i] = to_atlas(
              chart, project_to_chart(chart, mesh.vertices[mesh.triangles[t][i]].position_mm,
                                      options.texel_mm));
        }
        for_each_texel(corners, [&](int x, int y, const Vec3f&) {
          ++texels;
          taken.emplace(x, y);
        });
      }
    }
    EXPECT_EQ(std::count(charts_of.begin(), charts_of.end(), 1),
              static_cast<std::ptrdiff_t>(charts_of.size()));
    // Rounding may move a center on an edge to the other side when the corner of the chart is
    // added.
    EXPECT_LE(texels - taken.size(), texels / 1000);
  }
}

TEST(AtlasCharts, PackedChartsDoNotOverlap) {
  std::vector<Chart> charts = *cut_charts(wave(4.0F), {});
  ASSERT_GT(charts.size(), 2U);
  ASSERT_TRUE(pack_charts(charts, 1024));
  for (std::size_t a = 0; a < charts.size(); ++a) {
    EXPECT_TRUE((charts[a].corner_px >= 0).all());
    EXPECT_TRUE((charts[a].corner_px + charts[a].size_px <= 1024).all());
    for (std::size_t b = 0; b < a; ++b) {
      const bool apart = (charts[a].corner_px >= charts[b].corner_px + charts[b].size_px).any() ||
                         (charts[b].corner_px >= charts[a].corner_px + charts[a].size_px).any();
      EXPECT_TRUE(apart) << a << " and " << b;
    }
  }
  EXPECT_FALSE(pack_charts(charts, 16));
}

TEST(BakeAtlas, ColorsAreAtTheRightPlaces) {
  TriangleMesh mesh = wave(0.5F);
  const std::vector<TextureFrame> frames = {two_colors()};
  const auto baked = bake_atlas(mesh, frames, six_sided_calibration(), {}, Workers(2));
  ASSERT_TRUE(baked.has_value());
  for (SurfacePoint& vertex : mesh.vertices) {
    vertex.color = vertex.position_mm.x() < 0.0F ? Rgb{200, 40, 40} : Rgb{40, 40, 200};
  }
  const evaluation::ColorError error =
      evaluation::color_error(baked->model, mesh, 0.01, Workers(2));
  EXPECT_EQ(error.count, static_cast<std::int64_t>(baked->model.mesh.vertices.size()));
  EXPECT_LT(error.percentile_95, 0.01);
  EXPECT_GT(error.median_by_chance, 0.1);
}

/// A camera with a lamp in front of each of the six sides of a sphere at the origin. A pixel shows
/// the color of its direction, under the light that arrives there.
template <typename ColorOf>
std::vector<TextureFrame> six_sides(float radius_mm, const ColorOf& color_of) {
  std::vector<TextureFrame> frames;
  for (const Vec3& gaze : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0),
                           Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    Isometry T_world_sensor = Isometry::Identity();
    const Vec3 right = gaze.unitOrthogonal();
    T_world_sensor.linear() << right, gaze.cross(right), gaze;
    cv::Mat image(480, 640, CV_8UC3, cv::Scalar(1, 1, 1));
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        const double x = (u - 320) / 20.0, y = (v - 240) / 20.0;
        const double z2 = radius_mm * radius_mm - x * x - y * y;
        if (z2 < 0.0) continue;
        const Vec3 place = T_world_sensor * Vec3(x, y, -std::sqrt(z2));
        const Rgb color = color_of(place.cast<float>().normalized());
        const auto cosine = static_cast<float>(std::sqrt(z2)) / radius_mm;
        for (int c = 0; c < 3; ++c) {
          image.at<cv::Vec3b>(v, u)[c] =
              srgb_from_linear(cosine * linear_from_srgb(color[static_cast<std::size_t>(c)]));
        }
      }
    }
    frames.push_back({image, T_world_sensor});
  }
  return frames;
}

TEST(BakeAtlas, RecoversThePatternOfASphere) {
  TriangleMesh sphere = colored_sphere().mesh;
  const float radius_mm = sphere.vertices.front().position_mm.norm();
  const auto color_of = [](const Vec3f& direction) {
    const Vec3f light = (Vec3f::Constant(120.0F) + 80.0F * direction).array().round();
    return Rgb{static_cast<std::uint8_t>(light.x()), static_cast<std::uint8_t>(light.y()),
               static_cast<std::uint8_t>(light.z())};
  };
  const auto baked =
      bake_atlas(sphere, six_sides(radius_mm, color_of), six_sided_calibration(), {}, Workers(2));
  ASSERT_TRUE(baked.has_value());
  // Every direction is within 55 degrees of one camera, so no surface is at grazing incidence.
  EXPECT_EQ(baked->texels.untextured, 0U);
  double sum = 0.0;
  for (std::size_t i = 0; i < baked->model.uv.size(); ++i) {
    const Eigen::Vector2f px = baked->model.uv[i] * static_cast<float>(baked->model.atlas.cols);
    const auto& found =
        baked->model.atlas.at<cv::Vec3b>(static_cast<int>(px.y()), static_cast<int>(px.x()));
    const Rgb truth = color_of(baked->model.mesh.vertices[i].position_mm.normalized());
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(found[c] - truth[static_cast<std::size_t>(c)]);
      // A pixel may be a texel and the sag of a facet away.
      EXPECT_LT(difference, 16.0) << "vertex " << i;
      sum += difference;
    }
  }
  EXPECT_LT(sum / static_cast<double>(3 * baked->model.uv.size()), 3.0);
}

TEST(BakeAtlas, HiddenSurfaceIsNotPainted) {
  TriangleMesh mesh = wave(0.5F);
  const TriangleMesh front = mesh;
  const auto count = static_cast<std::uint32_t>(front.vertices.size());
  for (SurfacePoint& vertex : mesh.vertices) {
    vertex.position_mm.z() += 5.0F;
    vertex.color = {10, 200, 30};
  }
  mesh.vertices.insert(mesh.vertices.end(), front.vertices.begin(), front.vertices.end());
  for (const Triangle& t : front.triangles) {
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  const auto baked =
      bake_atlas(mesh, std::vector{two_colors()}, six_sided_calibration(), {}, Workers(2));
  ASSERT_TRUE(baked.has_value());
  std::size_t green = 0;
  for (std::size_t i = 0; i < baked->model.uv.size(); ++i) {
    const Eigen::Vector2f px = baked->model.uv[i] * static_cast<float>(baked->model.atlas.cols);
    const auto& found =
        baked->model.atlas.at<cv::Vec3b>(static_cast<int>(px.y()), static_cast<int>(px.x()));
    const bool behind = baked->model.mesh.vertices[i].position_mm.z() > 2.0F;
    EXPECT_EQ(found == cv::Vec3b(10, 200, 30), behind) << "vertex " << i;
    green += behind ? 1U : 0U;
  }
  EXPECT_GE(green, static_cast<std::size_t>(count));
}

TEST(BakeAtlas, UnobservedSurfaceKeepsTheColorOfItsVertices) {
  TriangleMesh mesh = wave(0.5F);
  for (SurfacePoint& vertex : mesh.vertices) vertex.color = {10, 200, 30};
  const auto baked = bake_atlas(mesh, {}, six_sided_calibration(), {}, Workers(2));
  ASSERT_TRUE(baked.has_value());
  EXPECT_EQ(baked->texels.observed, 0U);
  EXPECT_LT(evaluation::color_error(baked->model, mesh, 0.01, Workers(1)).percentile_95, 1e-6);
}

TEST(BakeAtlas, ASmallAtlasHasLargerTexels) {
  const TriangleMesh mesh = wave(0.5F);
  AtlasOptions small;
  small.max_side_px = 64;
  const auto coarse = bake_atlas(mesh, {}, six_sided_calibration(), small, Workers(1));
  const auto fine = bake_atlas(mesh, {}, six_sided_calibration(), {}, Workers(1));
  ASSERT_TRUE(coarse && fine);
  EXPECT_LE(coarse->model.atlas.cols, 64);
  EXPECT_NEAR(fine->texel_mm, 1.0 / 20.0, 1e-9);
  EXPECT_GT(coarse->texel_mm, 2.0 * fine->texel_mm);
}

TEST(BakeAtlas, AnyNumberOfThreadsGivesTheSameBits) {
  const TriangleMesh mesh = wave(2.0F);
  const std::vector<TextureFrame> frames = {two_colors()};
  const auto one = bake_atlas(mesh, frames, six_sided_calibration(), {}, Workers(1));
  const auto four = bake_atlas(mesh, frames, six_sided_calibration(), {}, Workers(4));
  ASSERT_TRUE(one && four);
  EXPECT_EQ(cv::norm(one->model.atlas, four->model.atlas, cv::NORM_INF), 0.0);
  EXPECT_EQ(one->model.uv, four->model.uv);
}

TEST(BakeAtlas, RejectsBadInput) {
  AtlasOptions options;
  options.max_side_px = 1000;
  EXPECT_EQ(bake_atlas(wave(1.0F), {}, six_sided_calibration(), options, Workers(1)).error().code,
            ErrorCode::kBadOption);
  EXPECT_EQ(bake_atlas({}, {}, six_sided_calibration(), {}, Workers(1)).error().code,
            ErrorCode::kInsufficient);
}

}  // namespace
}  // namespace flytri::texture
