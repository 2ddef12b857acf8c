#include <benchmark/benchmark.h>

#include <cmath>

#include "core/tracking/registrar.h"
#include "tests/support/wavy_scene.h"

namespace flytri {
namespace {

Isometry hand_pose(double t) {
  Twist twist;
  twist << 0.15 * std::sin(0.9 * t), 0.12 * std::cos(0.7 * t), 0.4 * std::sin(0.5 * t),
      6.0 * std::sin(0.55 * t), 5.0 * std::cos(0.8 * t), 0.5 * std::sin(1.1 * t);
  return exp_twist(twist);
}

/// View `frame` of a scan, with about as many points as from a 1024x768 image.
std::shared_ptr<const View> scene_view(int frame) {
  Random random(17, static_cast<std::uint64_t>(frame));
  testing::SceneSensor sensor;
  sensor.points_per_line = 700;
  const Pattern pattern = frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
  auto view = std::make_shared<View>(testing::measure_scene(testing::cusped_height, sensor, pattern,
                                                            hand_pose(frame / 30.0), random));
  view->frame = FrameIndex(frame);
  view->time_s = frame / 30.0;
  return view;
}

void prepare(benchmark::State& state) {
  const auto view = scene_view(0);
  for (auto _ : state) benchmark::DoNotOptimize(registration::prepare_view(*view));
}
BENCHMARK(prepare)->Unit(benchmark::kMicrosecond);

void closest_pair_brute_force(benchmark::State& state) {
  const registration::PreparedView first = registration::prepare_view(*scene_view(0)),
                                   second = registration::prepare_view(*scene_view(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(registration::closest_knots_brute_force(
        first.profiles[4].curve, second.profiles[3].curve, 1.0));
  }
}
BENCHMARK(closest_pair_brute_force)->Unit(benchmark::kMicrosecond);

void closest_pair_hierarchical(benchmark::State& state) {
  const registration::PreparedView first = registration::prepare_view(*scene_view(0)),
                                   second = registration::prepare_view(*scene_view(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        registration::closest_knots(first.profiles[4], second.profiles[3], 1.0));
  }
}
BENCHMARK(closest_pair_hierarchical)->Unit(benchmark::kMicrosecond);

void align_to_one_view(benchmark::State& state) {
  const registration::PreparedView target = registration::prepare_view(*scene_view(0)),
                                   source = registration::prepare_view(*scene_view(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(registration::align_view(source, target, Isometry::Identity()));
  }
}
BENCHMARK(align_to_one_view)->Unit(benchmark::kMillisecond);

void align_to_many_views(benchmark::State& state) {
  const Isometry T_world_first = hand_pose(0.0).inverse();
  std::vector<registration::PreparedView> placed;
  const auto count = static_cast<int>(state.range(0));
  for (int i = 0; i < count; ++i) {
    placed.push_back(
        registration::prepare_view(*scene_view(i)).moved(T_world_first * hand_pose(i / 30.0)));
  }
  std::vector<const registration::PreparedView*> metaview;
  for (const registration::PreparedView& view : placed) metaview.push_back(&view);
  const registration::PreparedView source = registration::prepare_view(*scene_view(count));
  const Isometry T_world_guess = T_world_first * hand_pose((count - 1) / 30.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(registration::align_to_metaview(source, metaview, T_world_guess));
  }
}
BENCHMARK(align_to_many_views)->Arg(10)->Arg(25)->Arg(100)->Unit(benchmark::kMillisecond);

/// Mean time per view for scans of different length; it must not increase with the length.
void registrar(benchmark::State& state) {
  std::vector<std::shared_ptr<const View>> views;
  for (int i = 0; i < state.range(0); ++i) views.push_back(scene_view(i));
  for (auto _ : state) {
    tracking::Registrar scan = tracking::Registrar::create().value();
    for (const auto& view : views) benchmark::DoNotOptimize(scan.add(view));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(registrar)->Arg(50)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace flytri
