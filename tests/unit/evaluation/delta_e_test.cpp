#include "core/evaluation/delta_e.h"

#include <gtest/gtest.h>

namespace flytri::evaluation {
namespace {

/// A square of 10 mm with one color.
TriangleMesh square(const Rgb& color) {
  TriangleMesh mesh;
  for (const auto& [x, y] : {std::pair{0.F, 0.F}, {10.F, 0.F}, {10.F, 10.F}, {0.F, 10.F}}) {
    mesh.vertices.push_back({Vec3f(x, y, 0), Vec3f::UnitZ(), color, 0.0F});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

DeltaE compare(const TriangleMesh& result, const TriangleMesh& truth) {
  return delta_e({result, {}, {}}, truth, 0.3, Workers(2));
}

TEST(DeltaE, TheSameColorsDoNotDiffer) {
  const DeltaE error = compare(square({180, 120, 90}), square({180, 120, 90}));
  EXPECT_EQ(error.count, 4);
  EXPECT_NEAR(error.median, 0.0, 1e-6);
  EXPECT_NEAR(error.gain, 1.0, 1e-6);
}

TEST(DeltaE, OneGainForAllLightIsFree) {
  // Linear light 0.25 and 0.5.
  const DeltaE error = compare(square({137, 137, 137}), square({188, 188, 188}));
  EXPECT_NEAR(error.gain, 2.0, 0.02);
  EXPECT_LT(error.percentile_95, 0.01);
}

TEST(DeltaE, ComparesWithTheInterpolatedTruth) {
  // Black to white along x: the middle has half of the light, and one vertex far from the others.
  TriangleMesh truth = square({0, 0, 0});
  truth.vertices[1].color = truth.vertices[2].color = {255, 255, 255};
  TriangleMesh result;
  result.vertices = {{Vec3f(5, 5, 0.1F), Vec3f::UnitZ(), {188, 188, 188}, 0.0F},
                     {Vec3f(5, 5, 3.0F), Vec3f::UnitZ(), {9, 9, 9}, 0.0F}};
  const DeltaE error = compare(result, truth);
  EXPECT_EQ(error.count, 1);
  EXPECT_NEAR(error.gain, 1.0, 0.01);
}

/// L*a*b* (D65) of sRGB red (255, 0, 0): 53.24, 80.09, 67.20; of green (0, 128, 0): 46.23, -51.70,
/// 49.90.
TEST(DeltaE, IsTheDistanceInLab) {
  TriangleMesh result = square({255, 0, 0});
  TriangleMesh truth = square({255, 0, 0});
  truth.vertices[3].color = {0, 128, 0};
  result.vertices[0].position_mm = Vec3f(0, 10, 0.01F);  // a second vertex where the truth is green
  const DeltaE error = compare(result, truth);
  EXPECT_NEAR(error.gain, 1.0, 1e-6);
  EXPECT_NEAR(error.percentile_95, 133.1, 0.2);
}

}  // namespace
}  // namespace flytri::evaluation
