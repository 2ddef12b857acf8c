/// @file  Benchmarks of finishing: refinement and normals of 60 views, colors of a point cloud.
#include <benchmark/benchmark.h>

#include "core/normals/normals.h"
#include "core/refinement/refine.h"
#include "core/texture/color_points.h"
#include "tests/support/orthographic_calibration.h"
#include "tests/support/scan_scene.h"

namespace flytri {
namespace {

constexpr int kViewCount = 60;

std::int64_t point_count(const std::vector<AlignedView>& views) {
  std::size_t count = 0;
  for (const AlignedView& aligned : views) count += aligned.view->point_count();
  return static_cast<std::int64_t>(count);
}

void refine(benchmark::State& state) {
  const auto scan = testing::scan_cusps(kViewCount, {}, 3);
  const auto drifted = testing::with_drift(scan.views, 0.1, 4);
  for (auto _ : state) {
    auto views = drifted;
    benchmark::DoNotOptimize(refinement::refine_jointly(views, {}, Workers(1), {}));
  }
  state.SetItemsProcessed(state.iterations() * kViewCount);
}
BENCHMARK(refine)->Name("refine_jointly")->Unit(benchmark::kMillisecond);

void normals(benchmark::State& state) {
  const auto scan = testing::scan_cusps(kViewCount, {}, 3);
  for (auto _ : state)
    benchmark::DoNotOptimize(normals::crossing_normals(scan.views, {}, Workers(1)));
  state.SetItemsProcessed(state.iterations() * point_count(scan.views));
}
BENCHMARK(normals)->Name("crossing_normals")->Unit(benchmark::kMillisecond);

void color(benchmark::State& state) {
  PointCloud points;
  for (int i = 0; i < 100'000; ++i) {
    SurfacePoint point;
    point.position_mm = Vec3f(-9.0F + 0.06F * float(i % 300), -7.0F + 0.04F * float(i / 300), 0.0F);
    point.normal = -Vec3f::UnitZ();
    points.push_back(point);
  }
  const std::vector<texture::TextureFrame> frames(
      6, {cv::Mat(768, 1024, CV_8UC3, cv::Scalar(200, 150, 100)), Isometry::Identity()});
  const calibration::Calibration calibration =
      testing::orthographic_calibration({20, 15, 15}, {1024, 768}, 50.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(texture::color_points(points, frames, calibration, {}, Workers(1)));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}
BENCHMARK(color)->Name("color_points")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
