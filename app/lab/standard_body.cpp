#include "app/lab/standard_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/geometry/append_mesh.h"
#include "core/geometry/decompositions.h"
#include "core/geometry/sphere_mesh.h"

namespace flytri::lab {
namespace {

constexpr double kRadius_mm = 3.0;
/// Facets lie at most 0.2 µm below the sphere.
constexpr int kRings = 256;
const Vec2 kPlate_mm(10.0, 8.0);
constexpr double kThickness_mm = 3.0;
/// Teeth are numbered along the arch.
constexpr std::array<std::size_t, 5> kSphereTeeth = {0, 4, 6, 9, 13};
constexpr std::array<std::size_t, 2> kPlateTeeth = {11, 12};
/// Points farther from the true sphere or plate belong to something else.
constexpr double kOfPart_mm = 0.3;
constexpr double kCapCosine = 0.5;
constexpr double kPlateBorder_mm = 0.5;
constexpr std::size_t kLeastPoints = 100;

SurfacePoint point_at(const Vec3& position_mm, const Vec3& normal) {
  SurfacePoint point;
  point.position_mm = position_mm.cast<float>();
  point.normal = normal.cast<float>();
  return point;
}

/// A box below z = 0.
TriangleMesh make_plate(const Isometry& T_jaw_plate) {
  const Vec3 half(0.5 * kPlate_mm.x(), 0.5 * kPlate_mm.y(), 0.5 * kThickness_mm);
  constexpr std::array<std::pair<double, double>, 4> kCorners = {
      {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
  TriangleMesh plate;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 out = side * Vec3::Unit(axis);
      const Vec3 u = Vec3::Unit((axis + 1) % 3), v = out.cross(u);
      const auto first = static_cast<std::uint32_t>(plate.vertices.size());
      for (const auto& [a, b] : kCorners) {
        const Vec3 corner = half.cwiseProduct(out + a * u + b * v) - half.z() * Vec3::UnitZ();
        plate.vertices.push_back(point_at(T_jaw_plate * corner, T_jaw_plate.linear() * out));
      }
      plate.triangles.push_back({first, first + 1, first + 2});
      plate.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return plate;
}

/// The highest point of a tooth's cusps, above the middle of its neck.
Vec3 top_of(const sample_jaw::PlacedTooth& placed) {
  return placed.origin_mm + placed.tooth.form().height_mm * Vec3::UnitZ();
}

Isometry place_plate(const sample_jaw::Dentition& dentition) {
  const auto& [one, other] = kPlateTeeth;
  const Vec3 a = top_of(dentition.teeth[one]), b = top_of(dentition.teeth[other]);
  const Vec3 x = Vec3(b.x() - a.x(), b.y() - a.y(), 0.0).normalized();
  Isometry T_jaw_plate = Isometry::Identity();
  T_jaw_plate.linear() << x, Vec3::UnitZ().cross(x), Vec3::UnitZ();
  constexpr double kAboveCusps_mm = 1.0;
  T_jaw_plate.translation() = 0.5 * (a + b);
  T_jaw_plate.translation().z() = std::max(a.z(), b.z()) + kAboveCusps_mm;
  return T_jaw_plate;
}

/// Enough points of a part of the body.
Result<void> check_scanned(std::string_view part, const std::vector<Vec3>& points_mm) {
  if (points_mm.size() >= kLeastPoints) return {};
  return fail(ErrorCode::kInsufficient,
              "{}: only {} points of it were scanned, at least {} are needed; scan more views",
              part, points_mm.size(), kLeastPoints);
}

}  // namespace

StandardBody make_standard_body(const TriangleMesh& jaw, const sample_jaw::Dentition& dentition) {
  StandardBody body;
  body.surface = jaw;
  body.radius_mm = kRadius_mm;
  for (const std::size_t tooth : kSphereTeeth) {
    body.spheres_mm.push_back(top_of(dentition.teeth[tooth]));
    append(body.surface, sphere_mesh(body.spheres_mm.back(), kRadius_mm, kRings));
  }
  body.T_jaw_plate = place_plate(dentition);
  body.plate_mm = kPlate_mm;
  append(body.surface, make_plate(body.T_jaw_plate));
  return body;
}

Result<FittedSphere> fit_sphere(const TriangleMesh& scanned, const StandardBody& body,
                                std::size_t sphere) {
  const Vec3& true_center_mm = body.spheres_mm[sphere];
  std::vector<Vec3> points_mm;
  for (const SurfacePoint& vertex : scanned.vertices) {
    const Vec3 from_center_mm = vertex.position_mm.cast<double>() - true_center_mm;
    const double distance_mm = from_center_mm.norm();
    if (std::abs(distance_mm - body.radius_mm) < kOfPart_mm &&
        from_center_mm.z() > kCapCosine * distance_mm) {
      points_mm.push_back(vertex.position_mm.cast<double>());
    }
  }
  if (auto enough = check_scanned(fmt::format("sphere {}", sphere + 1), points_mm); !enough) {
    return tl::unexpected(enough.error());
  }
  const auto count = static_cast<Eigen::Index>(points_mm.size());
  FittedSphere fit{true_center_mm, body.radius_mm, 0.0};
  // Each step leaves the square of the former error: the first is a share of a millimeter.
  constexpr int kSteps = 6;
  for (int step = 0; step <= kSteps; ++step) {
    Eigen::MatrixXd rows(count, 4);
    Eigen::VectorXd off_mm(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vec3 from_center_mm = points_mm[static_cast<std::size_t>(i)] - fit.center_mm;
      off_mm[i] = from_center_mm.norm() - fit.radius_mm;
      rows.row(i) << from_center_mm.normalized().transpose(), 1.0;
    }
    fit.rms_mm = std::sqrt(off_mm.squaredNorm() / static_cast<double>(count));
    if (step == kSteps) break;
    const Eigen::VectorXd change = solve_least_squares(rows, off_mm).x;
    fit.center_mm += change.head<3>();
    fit.radius_mm += change[3];
  }
  return fit;
}

Result<double> plate_noise_mm(const TriangleMesh& scanned, const StandardBody& body) {
  const Isometry T_plate_jaw = body.T_jaw_plate.inverse();
  const Vec2 inside_mm = 0.5 * body.plate_mm - Vec2::Constant(kPlateBorder_mm);
  std::vector<Vec3> points_mm;
  Vec3 sum_mm = Vec3::Zero();
  for (const SurfacePoint& vertex : scanned.vertices) {
    const Vec3 p_mm = T_plate_jaw * vertex.position_mm.cast<double>();
    if (std::abs(p_mm.z()) < kOfPart_mm && std::abs(p_mm.x()) < inside_mm.x() &&
        std::abs(p_mm.y()) < inside_mm.y()) {
      points_mm.push_back(p_mm);
      sum_mm += p_mm;
    }
  }
  if (auto enough = check_scanned("the plate", points_mm); !enough) {
    return tl::unexpected(enough.error());
  }
  const auto count = static_cast<double>(points_mm.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Vec3& p_mm : points_mm) {
    moments += (p_mm - sum_mm / count) * (p_mm - sum_mm / count).transpose();
  }
  return std::sqrt(symmetric_eigen(moments).values[0] / count);
}

}  // namespace flytri::lab
