/// @file  Benchmark of taking triangles away, beside meshoptimizer with as many triangles left.
/// Set FLYTRI_BENCH_MODEL to a .ply of `flytri reconstruct` for a real surface.
#include <benchmark/benchmark.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstdlib>

#include "core/base/random.h"
#include "core/evaluation/surface_error.h"
#include "core/io/models/model.h"
#include "core/meshing/mesh_quality.h"
#include "core/meshing/mesh_surface.h"
#include "core/meshing/simplify.h"

namespace flytri {
namespace {

constexpr double kMicronsOfMm = 1e3, kPercent = 1e2;

/// A wavy surface of 8 x 8 mm, points 0.1 mm apart with 3 µm of noise.
TriangleMesh wavy_mesh() {
  Random random(1);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 6400; ++i) {
    const double x = 0.1 * (i % 80), y = 0.1 * (i / 80);
    SurfacePoint point;
    point.position_mm = Vec3(x, y, 0.3 * std::sin(x) + 0.003 * random.normal()).cast<float>();
    point.normal = Vec3(0.3 * std::cos(x), 0.0, -1.0).normalized().cast<float>();
    point.sigma_mm = 0.003F;
    points.push_back(point);
  }
  return meshing::mesh_surface(points, {}, Workers(1))->mesh;
}

const TriangleMesh& full_mesh() {
  static const TriangleMesh mesh = [] {
    const char* file = std::getenv("FLYTRI_BENCH_MODEL");
    if (file == nullptr) return wavy_mesh();
    auto model = io::read_model(file);
    return model ? std::move(model->mesh) : TriangleMesh();
  }();
  return mesh;
}

/// The middles of the triangles count beside the vertices.
double largest_distance_mm(const TriangleMesh& from, const TriangleMesh& to, double& rms_mm) {
  TriangleMesh places = from;
  for (const Triangle& triangle : from.triangles) {
    SurfacePoint middle;
    middle.position_mm.setZero();
    for (const std::uint32_t corner : triangle)
      middle.position_mm += from.vertices[corner].position_mm / 3.0F;
    places.vertices.push_back(middle);
  }
  const auto error = evaluation::surface_error(places, to, {}, {}, Workers());
  rms_mm = error->distance.rms_mm;
  return error->distance.max_mm;
}

void report(benchmark::State& state, std::vector<Triangle> triangles) {
  TriangleMesh light = full_mesh();
  light.triangles = std::move(triangles);
  const meshing::MeshQuality quality = meshing::mesh_quality(light);
  // Unused vertices are not part of the surface.
  std::vector<std::uint32_t> place(light.vertices.size(), UINT32_MAX);
  TriangleMesh used;
  for (Triangle triangle : light.triangles) {
    for (std::uint32_t& corner : triangle) {
      if (place[corner] == UINT32_MAX) {
        place[corner] = static_cast<std::uint32_t>(used.vertices.size());
        used.vertices.push_back(light.vertices[corner]);
      }
      corner = place[corner];
    }
    used.triangles.push_back(triangle);
  }
  double rms_mm = 0.0, back_rms_mm = 0.0;
  const double max_mm = largest_distance_mm(full_mesh(), used, rms_mm);
  const double back_max_mm = largest_distance_mm(used, full_mesh(), back_rms_mm);
  state.counters["triangles"] = static_cast<double>(used.triangles.size());
  state.counters["rms_um"] = kMicronsOfMm * rms_mm;
  state.counters["max_um"] = kMicronsOfMm * max_mm;
  state.counters["back_max_um"] = kMicronsOfMm * back_max_mm;
  state.counters["slivers_percent"] = kPercent * quality.sliver_share;
  state.counters["turned"] = static_cast<double>(quality.turned);
}

void simplify(benchmark::State& state) {
  if (full_mesh().triangles.empty()) return state.SkipWithError("FLYTRI_BENCH_MODEL: no mesh");
  std::vector<Triangle> light;
  for (auto _ : state) light = meshing::simplify(full_mesh(), {})->triangles;
  report(state, std::move(light));
}
BENCHMARK(simplify)->Unit(benchmark::kMillisecond);

/// @param state  range(0): options of meshoptimizer
void simplify_by_meshoptimizer(benchmark::State& state) {
  if (full_mesh().triangles.empty()) return state.SkipWithError("FLYTRI_BENCH_MODEL: no mesh");
  static const std::size_t goal = meshing::simplify(full_mesh(), {})->triangles.size();
  std::vector<unsigned int> indices, light;
  std::vector<float> positions_mm;
  for (const Triangle& triangle : full_mesh().triangles)
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  for (const SurfacePoint& vertex : full_mesh().vertices)
    positions_mm.insert(positions_mm.end(), vertex.position_mm.data(),
                        vertex.position_mm.data() + 3);
  for (auto _ : state) {
    light.resize(indices.size());
    light.resize(meshopt_simplify(light.data(), indices.data(), indices.size(), positions_mm.data(),
                                  full_mesh().vertices.size(), 3 * sizeof(float), 3 * goal,
                                  /*target_error=*/1.0F, static_cast<unsigned>(state.range(0)),
                                  /*result_error=*/nullptr));
  }
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < light.size(); i += 3)
    triangles.push_back({light[i], light[i + 1], light[i + 2]});
  report(state, std::move(triangles));
}
BENCHMARK(simplify_by_meshoptimizer)
    ->Arg(0)
    ->Arg(meshopt_SimplifyLockBorder)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
