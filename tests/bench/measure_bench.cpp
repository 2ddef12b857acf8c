/// @file  Benchmarks from image to view at 1024x768 on one core: each stage, both patterns.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/measurement/measure_view.h"
#include "tests/support/line_image.h"

namespace flytri {
namespace {

using testing::draw;
using testing::LineImage;
using testing::TrueLine;

/// Ten (vertical) or seven (horizontal) wavy lines with speckle, like an image of a jaw.
cv::Mat frame_image(Pattern pattern) {
  const bool vertical = pattern == Pattern::kVertical;
  LineImage image;
  image.along_count = vertical ? 768 : 1024;
  image.across_count = vertical ? 1024 : 768;
  image.speckle_contrast = 0.07;
  std::vector<TrueLine> lines;
  const int count = vertical ? 10 : 7;
  for (int n = 0; n < count; ++n) {
    const double middle = 60.0 + (image.across_count - 120.0) * n / (count - 1.0);
    lines.push_back({[middle](double r) { return middle + 15.0 * std::sin(0.01 * r + middle); },
                     1.8, [](double) { return 110.0; }});
  }
  return draw(image, lines, pattern);
}

void localize(benchmark::State& state, localization::LineEstimator estimator) {
  const auto pattern = static_cast<Pattern>(state.range(0));
  const cv::Mat image = frame_image(pattern);
  localization::LocalizeOptions options;
  options.estimator = estimator;
  std::size_t samples = 0;
  for (auto _ : state) {
    const auto traces = localization::localize_lines(image, pattern, options);
    samples = 0;
    for (const localization::LineTrace& trace : *traces) samples += trace.size();
  }
  state.counters["samples"] = static_cast<double>(samples);
}
BENCHMARK_CAPTURE(localize, weighted_fit, localization::LineEstimator::kWeightedFit)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(localize, three_point, localization::LineEstimator::kThreePoint)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

/// A calibration whose line areas contain the lines of frame_image; its values do not affect the
/// speed.
calibration::Calibration frame_calibration() {
  calibration::Calibration calibration;
  calibration.volume.size_mm = {20, 15, 15};
  calibration.measurement_size = {1024, 768};
  for (calibration::TrivariateCubic* cubic : {&calibration.x_mm, &calibration.y_mm}) {
    cubic->half_range = {512, 384, 8};
    for (int i = 0; i < 20; ++i) cubic->coefficients[static_cast<std::size_t>(i)] = 1.0 / (1 + i);
  }
  for (const Pattern pattern : kPatterns) {
    const bool vertical = pattern == Pattern::kVertical;
    const int count = vertical ? 10 : 7, across = vertical ? 1024 : 768;
    auto& lines = calibration.of(pattern);
    lines.lines.assign(static_cast<std::size_t>(count),
                       std::vector<calibration::LineRow>(vertical ? 768U : 1024U));
    lines.sheet_normals.assign(static_cast<std::size_t>(count), Vec3::UnitX());
    for (int n = 0; n < count; ++n) {
      const double middle = 60.0 + (across - 120.0) * n / (count - 1.0);
      const calibration::LineRow row{{middle, 40.0, {0, 7, 0.1, 0.01}},
                                     {middle, 40.0, {4.2, 0, 0}},
                                     middle - 40.0,
                                     middle + 40.0};
      std::fill(lines.lines[static_cast<std::size_t>(n)].begin(),
                lines.lines[static_cast<std::size_t>(n)].end(), row);
    }
  }
  return calibration;
}

void index(benchmark::State& state) {
  const auto pattern = static_cast<Pattern>(state.range(0));
  const auto traces = localization::localize_lines(frame_image(pattern), pattern, {});
  const calibration::Calibration calibration = frame_calibration();
  for (auto _ : state)
    benchmark::DoNotOptimize(indexing::index_lines(*traces, calibration, pattern, {}));
}
BENCHMARK(index)->Name("index_lines")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void triangulate_lines(benchmark::State& state) {
  const auto pattern = static_cast<Pattern>(state.range(0));
  const auto traces = localization::localize_lines(frame_image(pattern), pattern, {});
  const calibration::Calibration calibration = frame_calibration();
  const indexing::IndexedLines lines = indexing::index_lines(*traces, calibration, pattern, {});
  for (auto _ : state)
    benchmark::DoNotOptimize(triangulation::triangulate(lines, calibration, pattern, {}));
}
BENCHMARK(triangulate_lines)->Name("triangulate")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// For comparison: the time of OpenCV for smoothing alone, without peaks, fits and links.
void smooth_by_opencv(benchmark::State& state) {
  const cv::Mat image = frame_image(Pattern::kVertical);
  cv::setNumThreads(1);
  cv::Mat rows, smooth;
  for (auto _ : state) {
    image.convertTo(rows, CV_32F);
    cv::GaussianBlur(rows, smooth, {7, 1}, 1.0);
    benchmark::DoNotOptimize(smooth.data);
  }
}
BENCHMARK(smooth_by_opencv)->Unit(benchmark::kMillisecond);

void measure(benchmark::State& state) {
  const auto pattern = static_cast<Pattern>(state.range(0));
  const Frame frame{FrameIndex(0),
                    pattern == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal,
                    0.0, frame_image(pattern)};
  const calibration::Calibration calibration = frame_calibration();
  int points = 0;
  for (auto _ : state) points = measurement::measure_view(frame, calibration, {})->counts.points;
  state.counters["points"] = points;
}
BENCHMARK(measure)->Name("measure_view")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
