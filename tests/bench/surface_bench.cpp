#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/point_grid.h"
#include "core/meshing/mesh_surface.h"
#include "core/reduction/reduce.h"

namespace flytri {
namespace {

/// Line samples of `view_count` views of a wavy surface of 10 x 10 mm; 5000 samples per view.
std::vector<SurfaceSample> wavy_scan(int view_count) {
  Random random(1);
  std::vector<SurfaceSample> samples;
  for (int view = 0; view < view_count; ++view) {
    const double shift = random.uniform();
    for (int line = 0; line < 10; ++line) {
      for (int row = 0; row < 500; ++row) {
        const double x = line + shift;
        const Vec3 p(x, 0.02 * row, 0.3 * std::sin(x) + 0.02 * random.normal());
        const Vec3 normal = Vec3(0.3 * std::cos(x), 0.0, -1.0).normalized();
        samples.push_back(
            {p.cast<float>(), normal.cast<float>(), Vec3f(0, 0, 0.02F), ViewIndex(view)});
      }
    }
  }
  return samples;
}

void reduction(benchmark::State& state) {
  const std::vector<SurfaceSample> samples = wavy_scan(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(reduction::reduce_samples(samples, {}, Workers(1)));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.size()));
}
BENCHMARK(reduction)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond);

void mesh_points(benchmark::State& state) {
  const auto reduced = reduction::reduce_samples(wavy_scan(200), {}, Workers(1));
  for (auto _ : state)
    benchmark::DoNotOptimize(meshing::mesh_surface(reduced->points, {}, Workers(1)));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(reduced->points.size()));
}
BENCHMARK(mesh_points)->Unit(benchmark::kMillisecond);

void find_nearest_point(benchmark::State& state) {
  std::vector<Vec3f> points;
  for (const SurfaceSample& s : wavy_scan(100)) points.push_back(s.position_mm);
  const PointGrid grid(points, 0.1F);
  std::size_t i = 0;
  for (auto _ : state) {
    i = (i + 1) % points.size();
    benchmark::DoNotOptimize(grid.nearest(points[i] + Vec3f(0.01F, 0.01F, 0.01F), 1.0F));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(find_nearest_point);

}  // namespace
}  // namespace flytri
