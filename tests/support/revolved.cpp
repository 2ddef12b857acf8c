#include "tests/support/revolved.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/mesh_normals.h"

namespace flytri::testing {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Vec3 revolved_place(const Vec2& p_mm, double around) {
  return {p_mm.x() * std::cos(around), p_mm.x() * std::sin(around), p_mm.y()};
}

void add_vertex(TriangleMesh& mesh, const Vec3& p_mm) {
  SurfacePoint vertex;
  vertex.position_mm = p_mm.cast<float>();
  mesh.vertices.push_back(vertex);
}

/// A corner of a profile and how it is rounded.
struct Corner {
  Vec2 place_mm;
  double radius_mm;
};

/// The circle that rounds a corner.
struct Arc {
  Vec2 center_mm, from_mm, to_mm, middle_mm;
};

Arc arc_at(const Corner& corner, const Vec2& before_mm, const Vec2& after_mm) {
  const Vec2 back = (before_mm - corner.place_mm).normalized(),
             on = (after_mm - corner.place_mm).normalized();
  const double half = 0.5 * std::acos(back.dot(on));
  const double tangent_mm = corner.radius_mm / std::tan(half);
  const Vec2 inwards = (back + on).normalized();
  const Vec2 center_mm = corner.place_mm + corner.radius_mm / std::sin(half) * inwards;
  return {center_mm, corner.place_mm + tangent_mm * back, corner.place_mm + tangent_mm * on,
          center_mm - corner.radius_mm * inwards};
}

/// The profile in steps of about a micrometer; @param edge_mm  gets the middle of the last arc
std::vector<Vec2> rounded(const std::vector<Corner>& corners, Vec2& edge_mm) {
  std::vector<Vec2> profile_mm = {corners.front().place_mm};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Arc arc = arc_at(corners[i], corners[i - 1].place_mm, corners[i + 1].place_mm);
    const Vec2 from = arc.from_mm - arc.center_mm, to = arc.to_mm - arc.center_mm;
    const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
    constexpr int kSteps = 400;
    for (int k = 0; k <= kSteps; ++k)
      profile_mm.push_back(arc.center_mm + Eigen::Rotation2Dd(turn * k / kSteps) * from);
    edge_mm = arc.middle_mm;
  }
  profile_mm.push_back(corners.back().place_mm);
  return divided(profile_mm, 1e-3);
}

std::vector<Corner> corners_of(const PreparationOptions& options) {
  const double edge_mm = options.edge_radius_mm;
  if (options.finish_line == FinishLine::kShoulder)
    return {{{2.8, 2.5}, 0.0}, {{3.05, 0.0}, 0.3}, {{4.0, 0.0}, edge_mm}, {{3.8, -1.8}, 0.0}};
  return {{{2.9, 2.5}, 0.0}, {{3.15, 0.0}, 1.2}, {{4.0, -0.35}, edge_mm}, {{3.9, -2.0}, 0.0}};
}

/// Oval, and higher at two sides.
Vec3 shaped(const Vec2& p_mm, double around) {
  const Vec3 p = revolved_place(p_mm, around);
  return {p.x(), 0.85 * p.y(), p.z() + 0.4 * std::cos(2.0 * around)};
}

}  // namespace

TriangleMesh revolved(const std::vector<Vec2>& profile_mm, int columns) {
  TriangleMesh mesh;
  std::vector<std::vector<std::uint32_t>> rows;
  for (const Vec2& p_mm : profile_mm) {
    std::vector<std::uint32_t> row;
    for (int j = 0; j < columns; ++j) {
      if (j == 0 || p_mm.x() > 0.0) add_vertex(mesh, revolved_place(p_mm, kTurn * j / columns));
      row.push_back(static_cast<std::uint32_t>(mesh.vertices.size()) - 1);
    }
    rows.push_back(row);
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
  };
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    for (std::size_t j = 0; j < static_cast<std::size_t>(columns); ++j) {
      const std::size_t next = (j + 1) % static_cast<std::size_t>(columns);
      add(rows[i][j], rows[i + 1][j], rows[i][next]);
      add(rows[i][next], rows[i + 1][j], rows[i + 1][next]);
    }
  compute_vertex_normals(mesh);
  return mesh;
}

std::vector<Vec2> divided(const std::vector<Vec2>& profile_mm, double step_mm) {
  std::vector<Vec2> fine = {profile_mm.front()};
  for (std::size_t i = 1; i < profile_mm.size(); ++i) {
    const Vec2 step = profile_mm[i] - profile_mm[i - 1];
    const int count = std::max(1, static_cast<int>(std::ceil(step.norm() / step_mm - 1e-9)));
    for (int k = 1; k <= count; ++k) fine.push_back(profile_mm[i - 1] + step * k / count);
  }
  return fine;
}

Preparation preparation(const PreparationOptions& options) {
  Vec2 edge_mm = Vec2::Zero();
  const std::vector<Vec2> profile_mm = rounded(corners_of(options), edge_mm);
  std::vector<double> along_mm = {0.0};
  for (std::size_t i = 1; i < profile_mm.size(); ++i)
    along_mm.push_back(along_mm.back() + (profile_mm[i] - profile_mm[i - 1]).norm());
  const auto profile_at = [&](double wanted_mm) {
    const auto at = std::lower_bound(along_mm.begin(), along_mm.end(), wanted_mm);
    return profile_mm[std::min(static_cast<std::size_t>(at - along_mm.begin()),
                               profile_mm.size() - 1)];
  };
  Preparation made;
  const int rows = static_cast<int>(along_mm.back() / options.spacing_mm) - 3;
  const int columns = static_cast<int>(kTurn * 3.7 / options.spacing_mm);
  Random random(options.seed);
  // Rows wind up and down by more than a spacing, so that none lies along the edge.
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double around = kTurn * (j + 0.5 * (i % 2) + random.uniform(-0.2, 0.2)) / columns;
      const double row = i + 1.2 + 0.8 * std::sin(3.0 * around) + random.uniform(-0.2, 0.2);
      add_vertex(made.mesh, shaped(profile_at(options.spacing_mm * row), around));
    }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>(i * columns + j % columns);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int lower = i % 2 == 0 ? 0 : 1;  // odd rows are turned by half a column
      made.mesh.triangles.push_back({index(i, j), index(i + 1, j + lower), index(i, j + 1)});
      made.mesh.triangles.push_back(
          lower == 0 ? Triangle{index(i, j + 1), index(i + 1, j), index(i + 1, j + 1)}
                     : Triangle{index(i, j), index(i + 1, j), index(i + 1, j + 1)});
    }
  compute_vertex_normals(made.mesh);
  for (SurfacePoint& vertex : made.mesh.vertices) {
    vertex.sigma_mm = static_cast<float>(options.noise_mm);
    vertex.position_mm += static_cast<float>(options.noise_mm * random.normal()) * vertex.normal;
  }
  compute_vertex_normals(made.mesh);
  for (int k = 0; k < 1200; ++k) made.margin_mm.push_back(shaped(edge_mm, kTurn * k / 1200));
  return made;
}

}  // namespace flytri::testing
