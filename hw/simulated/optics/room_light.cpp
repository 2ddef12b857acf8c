#include "hw/simulated/optics/room_light.h"

namespace flytri::simulated {

double albedo_at(const TriangleMesh& mesh, std::span<const float> albedo, const RayHit& hit) {
  const Triangle& corners = mesh.triangles[hit.triangle];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += hit.weights[i] * albedo[corners[i]];
  return sum;
}

float albedo_at(const TriangleMesh& mesh, std::span<const float> albedo, std::uint32_t triangle,
                float u, float v) {
  const Triangle& corners = mesh.triangles[triangle];
  return (1.0F - u - v) * albedo[corners[0]] + u * albedo[corners[1]] + v * albedo[corners[2]];
}

double room_light(double level, double albedo, double facing) {
  return level * albedo * (0.5 + 0.5 * facing);
}

}  // namespace flytri::simulated
