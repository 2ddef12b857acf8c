#include "tests/support/cheek.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "assets/sample_jaw/sample_jaw.h"

namespace flytri::testing {

TriangleMesh coarse_jaw(JawKind kind, std::uint64_t seed) {
  sample_jaw::SampleJawOptions options;
  options.kind = kind;
  options.seed = seed;
  options.tooth_cell_mm = 0.3;
  options.gum_cell_mm = 0.5;
  return sample_jaw::make_sample_jaw(options, Workers()).value();
}

Isometry bite_relation() {
  return Isometry(Eigen::Translation3d(0.4, -0.3, 19.0) *
                  exp_twist((Twist() << 0.01, -0.02, 0.015, 0, 0, 0).finished()) *
                  Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY()));
}

Cheek::Cheek(const TriangleMesh& upper, const TriangleMesh& lower, const Isometry& T_upper_lower,
             bool is_right, std::uint64_t seed)
    : random_(seed),
      is_right_(is_right),
      // The sensor looks along z, from the cheek inwards.
      T_bite_upper_(Eigen::Translation3d(3.0, -2.0, 30.0) *
                    Eigen::AngleAxisd(0.4, Vec3(1.0, 0.5, -0.3).normalized()) *
                    Eigen::AngleAxisd((is_right ? 0.5 : -0.5) * std::numbers::pi, Vec3::UnitY())) {
  add(upper, Isometry::Identity());
  upper_count_ = mesh_.vertices.size();
  add(lower, T_upper_lower);
}

void Cheek::add_tissue(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const double y_mm = random_.uniform(-25.0, 10.0), z_mm = random_.uniform(0.0, 20.0);
    const double x_mm =
        (is_right_ ? 1.0 : -1.0) * (36.0 + std::sin(0.4 * y_mm) + std::cos(0.5 * z_mm));
    SurfacePoint point;
    point.position_mm = (T_bite_upper_ * Vec3(x_mm, y_mm, z_mm)).cast<float>();
    point.normal = (T_bite_upper_.linear() * Vec3(is_right_ ? 1.0 : -1.0, 0, 0)).cast<float>();
    mesh_.vertices.push_back(point);
  }
}

void Cheek::add(const TriangleMesh& jaw, const Isometry& T_upper_jaw) {
  const double side = is_right_ ? 1.0 : -1.0;
  std::vector<std::optional<std::uint32_t>> seen_as(jaw.vertices.size());
  for (std::size_t i = 0; i < jaw.vertices.size(); ++i) {
    const SurfacePoint& vertex = jaw.vertices[i];
    const Vec3 p_mm = T_upper_jaw * vertex.position_mm.cast<double>();
    const Vec3 normal = T_upper_jaw.linear() * vertex.normal.cast<double>();
    if (side * normal.x() < 0.3 || side * p_mm.x() < 14.0 || p_mm.y() > 14.0) continue;
    if (p_mm.z() < 2.0 || p_mm.z() > 17.0) continue;
    seen_as[i] = static_cast<std::uint32_t>(mesh_.vertices.size());
    SurfacePoint point = vertex;
    point.position_mm =
        (T_bite_upper_ * Vec3(p_mm + 0.01 * random_.normal() * normal)).cast<float>();
    point.normal = (T_bite_upper_.linear() * normal).cast<float>();
    mesh_.vertices.push_back(point);
  }
  for (const auto& [a, b, c] : jaw.triangles) {
    if (seen_as[a] && seen_as[b] && seen_as[c])
      mesh_.triangles.push_back({*seen_as[a], *seen_as[b], *seen_as[c]});
  }
}

}  // namespace flytri::testing
