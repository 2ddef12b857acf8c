#include "core/reconstruct/mesh_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/meshing/mesh_quality.h"
#include "tests/support/sample_meshes.h"

namespace flytri::reconstruct {
namespace {

/// A wave with a texture of half a texel for each step of the mesh.
TexturedMesh wave() {
  TexturedMesh model;
  model.mesh = height_field({.half_width_mm = 4.0, .step_mm = 0.1},
                            [](double x, double y) { return 0.3 * std::sin(0.8 * x + 0.5 * y); });
  model.atlas = cv::Mat(64, 64, CV_8UC3, cv::Scalar(1, 2, 3));
  for (const SurfacePoint& p : model.mesh.vertices)
    model.uv.emplace_back((p.position_mm.head<2>() + Vec3f::Constant(4.0F).head<2>()) / 8.0F);
  return model;
}

TEST(MeshDensity, EachIsLighterThanTheOneBefore) {
  const TexturedMesh full = wave();
  std::size_t before = full.mesh.triangles.size() + 1;
  for (const MeshDensity density : kMeshDensities) {
    const Result<ModelAtDensity> model = at_density(full, density);
    ASSERT_TRUE(model.has_value());
    EXPECT_LT(model->model.mesh.triangles.size(), before) << to_string(density);
    before = model->model.mesh.triangles.size();
    EXPECT_EQ(model->density, density);
    EXPECT_EQ(model->uncut.triangles.size(), before);
    EXPECT_TRUE(meshing::mesh_quality(model->uncut).is_manifold);
  }
}

TEST(MeshDensity, KeepsPlacesOfTheTexture) {
  const TexturedMesh full = wave();
  const Result<ModelAtDensity> cad = at_density(full, MeshDensity::kCad);
  ASSERT_TRUE(cad.has_value());
  EXPECT_EQ(cad->model.atlas.size(), full.atlas.size());
  ASSERT_EQ(cad->model.uv.size(), cad->model.mesh.vertices.size());
  for (std::size_t v = 0; v < cad->model.uv.size(); ++v) {
    const Vec3f& p = cad->model.mesh.vertices[v].position_mm;
    EXPECT_NEAR(cad->model.uv[v].x(), (p.x() + 4.0F) / 8.0F, 1e-6F);
    EXPECT_NEAR(cad->model.uv[v].y(), (p.y() + 4.0F) / 8.0F, 1e-6F);
  }
  EXPECT_GT(cad->rms_mm, 0.0);
  EXPECT_LE(cad->max_mm, 0.010);
}

TEST(MeshDensity, TenTimesAsLargeAMeshGetsTenTimesTheBounds) {
  TexturedMesh full = wave();
  const Result<ModelAtDensity> small = at_density(full, MeshDensity::kCad);
  ASSERT_TRUE(small.has_value());
  // Ten times as far apart as 0.2 mm.
  constexpr float kScale = 20.0F;
  for (SurfacePoint& p : full.mesh.vertices) p.position_mm *= kScale;
  const Result<ModelAtDensity> large = at_density(full, MeshDensity::kCad);
  ASSERT_TRUE(large.has_value());
  EXPECT_LE(large->max_mm, 0.101);
  EXPECT_GT(large->max_mm, 0.020);
  EXPECT_LT(large->model.mesh.triangles.size(), full.mesh.triangles.size() / 2);
}

TEST(MeshDensity, FullIsTheModelAsItIs) {
  const TexturedMesh full = wave();
  const Result<ModelAtDensity> same = at_density(full, MeshDensity::kFull);
  ASSERT_TRUE(same.has_value());
  EXPECT_EQ(same->model.mesh.triangles, full.mesh.triangles);
  EXPECT_EQ(same->max_mm, 0.0);
}

}  // namespace
}  // namespace flytri::reconstruct
