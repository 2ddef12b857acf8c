#include "assets/shapes/smooth.h"

#include "core/base/random.h"

namespace flytri::shapes {
namespace {

double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  const std::uint64_t cell = static_cast<std::uint64_t>(x * 73856093) ^
                             static_cast<std::uint64_t>(y * 19349663) ^
                             static_cast<std::uint64_t>(z * 83492791);
  return 2.0 * Random(seed ^ cell).uniform() - 1.0;
}

}  // namespace

double value_noise(const Vec3& p, std::uint64_t seed) {
  const Vec3 base = p.array().floor();
  const Vec3 t = p - base;
  const Vec3 w = t.array().square() * (3.0 - 2.0 * t.array());
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1;
    const int dy = (corner >> 1) & 1;
    const int dz = corner >> 2;
    const double weight =
        (dx ? w.x() : 1.0 - w.x()) * (dy ? w.y() : 1.0 - w.y()) * (dz ? w.z() : 1.0 - w.z());
    sum += weight * lattice_value(static_cast<std::int64_t>(base.x()) + dx,
                                  static_cast<std::int64_t>(base.y()) + dy,
                                  static_cast<std::int64_t>(base.z()) + dz, seed);
  }
  return sum;
}

}  // namespace flytri::shapes
