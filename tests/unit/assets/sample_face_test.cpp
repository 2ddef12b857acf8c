#include "assets/sample_face/sample_face.h"

#include <gtest/gtest.h>

namespace flytri::sample_face {
namespace {

TEST(SampleFace, HasTheSizeAndTheColorsOfAFace) {
  const TriangleMesh face = make_sample_face({.cell_mm = 2.0}).value();
  Eigen::AlignedBox3f box;
  int lips = 0, dark = 0;
  for (const SurfacePoint& vertex : face.vertices) {
    box.extend(vertex.position_mm);
    const int red = vertex.color[0], green = vertex.color[1];
    lips += red > green + 70 ? 1 : 0;
    dark += red < 130 ? 1 : 0;
  }
  EXPECT_NEAR(box.sizes().x(), 152.0, 15.0);
  EXPECT_NEAR(box.sizes().y(), 105.0, 15.0);
  EXPECT_NEAR(box.sizes().z(), 220.0, 10.0);
  const auto count = static_cast<double>(face.vertices.size());
  EXPECT_GT(lips / count, 0.005);
  EXPECT_LT(lips / count, 0.05);
  EXPECT_GT(dark / count, 0.005) << "eyebrows and pupils";
  EXPECT_LT(dark / count, 0.1);
}

TEST(SampleFace, IsTheSameForTheSameSeedOnly) {
  const TriangleMesh a = make_sample_face({.cell_mm = 4.0}).value();
  const TriangleMesh b = make_sample_face({.cell_mm = 4.0}).value();
  const TriangleMesh other = make_sample_face({.cell_mm = 4.0, .seed = 2}).value();
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    ASSERT_EQ(a.vertices[i].position_mm, b.vertices[i].position_mm);
    ASSERT_EQ(a.vertices[i].color, b.vertices[i].color);
  }
  EXPECT_NE(a.vertices.front().position_mm, other.vertices.front().position_mm);
}

TEST(SampleFace, RefusesATooFineGrid) { EXPECT_FALSE(make_sample_face({.cell_mm = 0.1})); }

}  // namespace
}  // namespace flytri::sample_face
