#include "hw/simulated/optics/lit_surface.h"

#include <gtest/gtest.h>

#include "core/geometry/sphere_mesh.h"
#include "hw/simulated/optics/view_simulator.h"

namespace flytri::simulated {
namespace {

/// Distance of each vertex to the nearest point of the views, mm.
std::vector<double> distances(const TriangleMesh& mesh, const std::vector<Exposure>& exposures,
                              const ViewSimulator& simulator) {
  std::vector<double> nearest(mesh.vertices.size(), 1e9);
  for (const Exposure& exposure : exposures) {
    const View view = simulator.trace(exposure.pattern, exposure.T_model_sensor);
    for (const Profile& profile : view.profiles) {
      for (const ProfilePoint& point : profile.points) {
        const Vec3 p = exposure.T_model_sensor * point.position_mm;
        for (std::size_t i = 0; i < nearest.size(); ++i) {
          nearest[i] =
              std::min(nearest[i], (mesh.vertices[i].position_mm.cast<double>() - p).norm());
        }
      }
    }
  }
  return nearest;
}

TEST(CountLit, CountsVerticesNearMeasuredPoints) {
  const TriangleMesh ball = sphere_mesh(Vec3(0.0, 0.0, 6.0), 6.0, 60);
  const auto simulator = ViewSimulator::create(ball, intraoral_sensor());
  ASSERT_TRUE(simulator.has_value());
  Isometry moved = Isometry::Identity();
  moved.translate(Vec3(0.4, 0.3, 0.0));
  const std::vector<Exposure> exposures{{Pattern::kVertical, Isometry::Identity()},
                                        {Pattern::kHorizontal, moved}};
  const auto counts = count_lit(simulator->scene(), simulator->sensor(), exposures, Workers(2));
  const auto distance_mm = distances(ball, exposures, *simulator);
  ASSERT_EQ(counts.size(), ball.vertices.size());
  std::size_t lit = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0.0) continue;
    ++lit;
    // Half the width of a line; more on steep surface.
    EXPECT_LT(distance_mm[i], 0.5) << ball.vertices[i].position_mm.transpose();
  }
  EXPECT_GT(lit, 50U);
  // Vertices on the middle of a line are lit, except at the ends of lines (too flat, or hidden).
  std::size_t missed = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    missed += distance_mm[i] < 0.02 && counts[i] == 0.0 ? 1U : 0U;
  }
  EXPECT_LE(missed, lit / 50);
}

TEST(CountLit, IsZeroOnTheFarSide) {
  const TriangleMesh ball = sphere_mesh(Vec3(0.0, 0.0, 6.0), 6.0, 30);
  const auto simulator = ViewSimulator::create(ball, intraoral_sensor());
  ASSERT_TRUE(simulator.has_value());
  const std::vector<Exposure> exposures{{Pattern::kVertical, Isometry::Identity()}};
  const auto counts = count_lit(simulator->scene(), simulator->sensor(), exposures, Workers(1));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (ball.vertices[i].position_mm.z() > 7.0F) {
      EXPECT_EQ(counts[i], 0.0);
    }
  }
}

}  // namespace
}  // namespace flytri::simulated
