#include "tests/support/point_bits.h"

#include <algorithm>

namespace flytri::testing {

std::vector<std::string> bits_in_ball(const std::vector<SurfacePoint>& points,
                                      const Vec3f& middle_mm, float radius_mm) {
  std::vector<std::string> all;
  for (const SurfacePoint& point : points) {
    if ((point.position_mm - middle_mm).norm() > radius_mm) continue;
    std::string& bits = all.emplace_back();
    const auto put = [&](const auto& part) {
      bits.append(reinterpret_cast<const char*>(&part), sizeof(part));
    };
    for (const float part : point.position_mm) put(part);
    for (const float part : point.normal) put(part);
    put(point.sigma_mm);
    put(point.color);
    put(point.patterns);
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace flytri::testing
