#include "tests/support/colored_sphere.h"

#include <cmath>
#include <numbers>

namespace flytri {
namespace {

constexpr int kRings = 16;
constexpr int kSectors = 32;
constexpr float kRadius_mm = 8.0F;

SurfacePoint point_at(int ring, int sector) {
  const double polar = std::numbers::pi * ring / kRings;
  const double azimuth = 2.0 * std::numbers::pi * sector / kSectors;
  SurfacePoint point;
  point.normal = Vec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                      std::cos(polar))
                     .cast<float>();
  point.position_mm = kRadius_mm * point.normal;
  point.color = {static_cast<std::uint8_t>(16 * ring % 256),
                 static_cast<std::uint8_t>(8 * sector % 256), 90};
  point.sigma_mm = 0.001F * static_cast<float>(ring + sector);
  return point;
}

void add_quad(TriangleMesh& mesh, int ring, int sector) {
  const auto index = [](int r, int s) {
    return static_cast<std::uint32_t>(r * (kSectors + 1) + s);
  };
  // At the poles, one of the two triangles has no area and is left out.
  if (ring > 0) {
    mesh.triangles.push_back(
        {index(ring, sector), index(ring + 1, sector), index(ring, sector + 1)});
  }
  if (ring < kRings - 1) {
    mesh.triangles.push_back(
        {index(ring, sector + 1), index(ring + 1, sector), index(ring + 1, sector + 1)});
  }
}

}  // namespace

TexturedMesh colored_sphere() {
  TexturedMesh model;
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int sector = 0; sector <= kSectors; ++sector) {
      model.mesh.vertices.push_back(point_at(ring, sector));
      if (ring < kRings && sector < kSectors) add_quad(model.mesh, ring, sector);
    }
  }
  return model;
}

TexturedMesh textured_sphere() {
  TexturedMesh model = colored_sphere();
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int sector = 0; sector <= kSectors; ++sector) {
      model.uv.emplace_back(static_cast<float>(sector) / kSectors,
                            static_cast<float>(ring) / kRings);
    }
  }
  model.atlas.create(32, 64, CV_8UC3);
  for (int v = 0; v < model.atlas.rows; ++v) {
    for (int u = 0; u < model.atlas.cols; ++u) {
      model.atlas.at<cv::Vec3b>(v, u) =
          (u / 8 + v / 8) % 2 == 0 ? cv::Vec3b(200, 60, 40) : cv::Vec3b(240, 235, 210);
    }
  }
  return model;
}

}  // namespace flytri
