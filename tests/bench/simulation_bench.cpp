#include <benchmark/benchmark.h>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/geometry/mesh_distance.h"
#include "hw/simulated/optics/sensor_path.h"
#include "hw/simulated/optics/view_simulator.h"

namespace flytri {
namespace {

const TriangleMesh& jaw() {
  static const TriangleMesh mesh = sample_jaw::make_sample_jaw({}, Workers()).value();
  return mesh;
}

void make_jaw(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(sample_jaw::make_sample_jaw({}, Workers(1)).value());
}
BENCHMARK(make_jaw)->Unit(benchmark::kMillisecond)->Iterations(1);

void trace_view(benchmark::State& state) {
  const auto simulator =
      simulated::ViewSimulator::create(jaw(), simulated::intraoral_sensor()).value();
  const simulated::SensorPath path =
      simulated::plan_path(simulator.scene(), simulator.sensor(), {}).value();
  int i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        simulator.trace(kPatterns[i % 2], path.T_model_sensor(0.5 * (i % 60))).point_count()),
        ++i;
}
BENCHMARK(trace_view)->Unit(benchmark::kMillisecond);

void closest_on_jaw(benchmark::State& state) {
  const MeshDistance distance(jaw());
  std::size_t i = 0;
  for (auto _ : state) {
    const Vec3f query =
        jaw().vertices[i++ % jaw().vertices.size()].position_mm + Vec3f(0.01F, 0.02F, 0.03F);
    benchmark::DoNotOptimize(distance.closest(query));
  }
}
BENCHMARK(closest_on_jaw);

}  // namespace
}  // namespace flytri
