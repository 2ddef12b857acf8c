#include "hw/simulated/datasets/passing_tissue.h"

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/sphere_mesh.h"

namespace flytri::simulated {
namespace {

constexpr double kVisit_s = 0.4;
constexpr int kBodyRings = 40;
/// Wet mucosa, sRGB.
constexpr Rgb kMucosa = {205, 120, 115};

}  // namespace

PassingTissue::PassingTissue(const SensorPath& path, const SensorModel& sensor, double share,
                             std::uint64_t seed) {
  if (!(share > 0.0)) return;
  const double period_s = kVisit_s / share;
  const Vec3 half_mm = 0.5 * sensor.volume.size_mm;
  for (int i = 0; path.start_s() + i * period_s < path.end_s(); ++i) {
    Random random(seed, 2000003ULL + static_cast<std::uint64_t>(i));
    Visit visit;
    visit.begin_s = path.start_s() + i * period_s + random.uniform() * (period_s - kVisit_s);
    visit.T_model_sensor = path.T_model_sensor(visit.begin_s + 0.5 * kVisit_s);
    visit.half_axes_mm =
        half_mm.x() * Vec3(0.5 + 0.3 * random.uniform(), 0.5 + 0.3 * random.uniform(),
                           0.6 + 0.3 * random.uniform());
    // Sensor frame, z away from the camera: the body's near end lies between the camera and the
    // middle of the volume.
    const double from = 2.0 * std::numbers::pi * random.uniform();
    const Vec3 side(std::cos(from), std::sin(from), 0.0);
    const double radius_mm = visit.half_axes_mm.head<2>().maxCoeff();
    const Vec3 middle_mm(0.0, 0.0,
                         visit.half_axes_mm.z() - half_mm.z() * (0.3 + 0.5 * random.uniform()));
    const double edge_mm = half_mm.x() * (0.2 + 0.5 * random.uniform());
    visit.inside_mm = middle_mm + (edge_mm + radius_mm) * side;
    visit.outside_mm = middle_mm + (half_mm.head<2>().norm() + 2.0 * radius_mm) * side;
    visits_.push_back(visit);
  }
}

TriangleMesh PassingTissue::at(double time_s) const {
  for (const Visit& visit : visits_) {
    const double done = (time_s - visit.begin_s) / kVisit_s;
    if (done < 0.0 || done > 1.0) continue;
    const double inside = std::sin(std::numbers::pi * done);
    const Vec3 center_mm = visit.outside_mm + inside * (visit.inside_mm - visit.outside_mm);
    TriangleMesh body = sphere_mesh(Vec3::Zero(), 1.0, kBodyRings);
    for (SurfacePoint& vertex : body.vertices) {
      const Vec3 unit = vertex.position_mm.cast<double>();
      const Vec3 place_mm = center_mm + visit.half_axes_mm.cwiseProduct(unit);
      const Vec3 normal = unit.cwiseQuotient(visit.half_axes_mm).normalized();
      vertex.position_mm = (visit.T_model_sensor * place_mm).cast<float>();
      vertex.normal = (visit.T_model_sensor.linear() * normal).cast<float>();
      vertex.color = kMucosa;
    }
    return body;
  }
  return {};
}

}  // namespace flytri::simulated
