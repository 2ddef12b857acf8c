#include <benchmark/benchmark.h>

#include <chrono>
#include <thread>

#include "core/scan/live_scan.h"
#include "tests/support/orthographic_calibration.h"
#include "tests/support/scan_scene.h"

namespace flytri {
namespace {

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// `view_count` views of 4500 points each, at twelve places of 20 x 15 mm in turn: about the area
/// of a jaw. The same 100 simulated views serve all places.
std::vector<AlignedView> views_of_a_jaw(int view_count) {
  constexpr int kPlaces = 12, kSimulated = 100;
  const testing::TrueScan simulated = testing::scan_cusps(kSimulated, {}, 3);
  std::vector<AlignedView> views;
  for (int i = 0; i < view_count; ++i) {
    const auto& [of_place, T_place_sensor] = simulated.views[static_cast<std::size_t>(i % 100)];
    auto view = std::make_shared<View>(*of_place);
    view->frame = FrameIndex(i);
    view->time_s = i / 30.0;
    const int place = kPlaces * i / view_count;
    const Eigen::Translation3d T_world_place(22.0 * (place % 4), 18.0 * (place / 4), 0.0);
    views.push_back({std::move(view), T_world_place * T_place_sensor});
  }
  return views;
}

/// Waits until the model is another one than before.
void await_change(const scan::LiveScan& scan, const SurfelModel& before) {
  while (scan.snapshot()->model == before)
    std::this_thread::sleep_for(std::chrono::microseconds(200));
}

/// From the command to the published model.
void undo_and_redo_an_edit(benchmark::State& state) {
  scan::LiveScanOptions options;
  options.now_s = steady_s;
  // So that other programs do not delay what is done before the edit.
  options.background = TaskThread::Priority::kNormal;
  const auto calibration = std::make_shared<calibration::Calibration>(
      testing::orthographic_calibration({20, 15, 15}, {64, 48}, 3.0));
  scan::KeptScan kept;
  kept.views = views_of_a_jaw(static_cast<int>(state.range(0)));
  const auto scan = std::move(scan::LiveScan::create(calibration, options, kept).value());
  kept = {};
  scan->wait_until_idle();
  const auto full = scan->snapshot();
  const Surfel at = full->model[full->model.size() / 2]->surfels.front();
  std::vector<editing::BrushDab> dabs;
  for (int i = 0; i < 20; ++i) {
    dabs.push_back({at.position_mm + Vec3f(0.5F * static_cast<float>(i), 0, 0), at.normal, 2.0F});
  }
  scan->edit(editing::EditKind::kTrim, dabs);
  scan->wait_until_idle();
  double undo_s = 0.0, redo_s = 0.0;
  for (auto _ : state) {
    const double before_s = undo_s + redo_s;
    for (double* const took_s : {&undo_s, &redo_s}) {
      const auto before = scan->snapshot();
      const double began_s = steady_s();
      if (took_s == &undo_s) {
        scan->undo();
      } else {
        scan->redo();
      }
      await_change(*scan, before->model);
      *took_s += steady_s() - began_s;
      scan->wait_until_idle();
    }
    state.SetIterationTime(0.5 * (undo_s + redo_s - before_s));
  }
  const auto count = static_cast<double>(state.iterations());
  state.counters["undo_ms"] = 1e3 * undo_s / count;
  state.counters["redo_ms"] = 1e3 * redo_s / count;
}
BENCHMARK(undo_and_redo_an_edit)
    ->Arg(500)
    ->Arg(4000)
    ->Arg(10000)
    ->Iterations(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
