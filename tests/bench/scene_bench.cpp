/// @file  Frame times of the scene at 1280x800. Needs a display, for instance an Xvfb.
#include <benchmark/benchmark.h>

#include "assets/sample_jaw/sample_jaw.h"
#include "tests/support/gl_context.h"
#include "ui/scene/frame_times.h"
#include "ui/scene/sample_surfels.h"

namespace flytri {
namespace {

void report(benchmark::State& state, const char* name, const ui::FrameTime& time) {
  state.counters[std::string(name) + "_ms"] = time.median_ms;
  state.counters[std::string(name) + "_95_ms"] = time.percentile_95_ms;
  state.counters[std::string(name) + "_processor_ms"] = time.processor_ms;
}

/// The sample jaw in state.range(0) surfels.
void scene_frames(benchmark::State& state) {
  const auto context = testing::GlContext::create();
  if (!context) {
    state.SkipWithError(testing::kNoDisplay);
    return;
  }
  const auto mesh = sample_jaw::make_sample_jaw({}, Workers());
  auto renderer = ui::SceneRenderer::create();
  if (!mesh || !renderer) {
    state.SkipWithError("no sample jaw or no renderer");
    return;
  }
  const SurfelModel model = ui::sample_surfels(*mesh, static_cast<std::size_t>(state.range(0)), 1);
  ui::FrameTimes times;
  for (auto _ : state) times = ui::measure_frame_times(*renderer, model, {1280, 800});
  state.counters["surfels"] = static_cast<double>(times.surfels);
  report(state, "whole", times.whole);
  report(state, "governed", times.governed);
  state.counters["detail_share"] = times.detail_share;
  report(state, "growing", times.growing);
  state.counters["replaced"] = static_cast<double>(times.replaced);
  report(state, "idle", times.idle);
}
BENCHMARK(scene_frames)
    ->Arg(50'000)
    ->Arg(200'000)
    ->Arg(1'000'000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
