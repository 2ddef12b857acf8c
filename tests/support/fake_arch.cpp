#include "tests/support/fake_arch.h"

#include <cmath>
#include <memory>

namespace flytri::testing {

SurfelModel arch(double half_length_mm, double bend, const Isometry& T_world_arch) {
  auto block = std::make_shared<SurfelBlock>();
  for (double x = -half_length_mm; x <= half_length_mm; x += 0.5) {
    const double y = -bend * x * x / half_length_mm;
    const Vec3 out = Vec3(2.0 * bend * x / half_length_mm, 1.0, 0.0).normalized();
    for (double around = -1.4; around <= 1.4; around += 0.1) {
      const Vec3 n = std::sin(around) * out + std::cos(around) * Vec3::UnitZ();
      Surfel s;
      s.position_mm = (T_world_arch * (Vec3(x, y, 0.0) + 4.0 * n)).cast<float>();
      s.normal = (T_world_arch.linear() * n).cast<float>();
      s.radius_mm = 0.4F;
      block->surfels.push_back(s);
    }
  }
  return {block};
}

}  // namespace flytri::testing
