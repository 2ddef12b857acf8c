#include "hw/simulated/room_light.h"

namespace flytri {

double albedo_at(const TriangleMesh& mesh, std::span<const float> albedo, const RayHit& hit) {
  const Triangle& corners = mesh.triangles[hit.triangle];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += hit.weights[i] * albedo[corners[i]];
  return sum;
}

double room_light(double level, double albedo, double facing) {
  return level * albedo * (0.5 + 0.5 * facing);
}

}  // namespace flytri
