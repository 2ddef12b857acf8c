#include "app/lab/enamel_samples.h"

#include <map>
#include <utility>

#include "core/indexing/index_lines.h"
#include "core/localization/localize.h"
#include "core/triangulation/triangulate.h"
#include "hw/simulated/optics/chip.h"

namespace flytri::lab {
namespace {

using SampleKey = std::pair<LineIndex, int>;  // line and row
using SampleMap = std::map<SampleKey, localization::LineSample>;

SampleMap by_line_and_row(const indexing::IndexedLines& lines) {
  SampleMap samples;
  for (const indexing::IndexedTrace& trace : lines.traces)
    for (const localization::LineSample& sample : trace.samples)
      samples.emplace(SampleKey(trace.line, sample.along_px), sample);
  return samples;
}

// Appends the points of one image.
Result<void> measure_image(const cv::Mat& image, const EnamelScene& scene,
                           const EnamelImages& images, std::vector<EnamelSample>& measured) {
  const auto traces = localization::localize_lines(image, kEnamelPattern, {});
  if (!traces) return tl::unexpected(traces.error());
  const auto lines = indexing::index_lines(*traces, images.calibration, kEnamelPattern, {});
  const View view = triangulation::triangulate(lines, images.calibration, kEnamelPattern, {}).view;
  const SampleMap samples = by_line_and_row(lines);
  int run = measured.empty() ? 0 : measured.back().run;
  for (const Profile& profile : view.profiles) {
    ++run;
    for (const ProfilePoint& point : profile.points) {
      if (!scene.is_measured(point.position_mm)) continue;
      const int row = static_cast<int>(point.along_px);
      const localization::LineSample& sample = samples.at({profile.line, row});
      const calibration::LineRow& calibrated =
          images.calibration.of(kEnamelPattern)
              .lines[profile.line.at()][static_cast<std::size_t>(row)];
      const auto shape =
          line_shape(image, kEnamelPattern, sample,
                     {calibrated.width_px(sample.across_px), away_from_projector(images.sensor)});
      if (!shape) continue;
      measured.push_back({scene.below_mm(point.position_mm), sample.saturated, *shape, run});
    }
  }
  return {};
}

}  // namespace

Result<std::vector<EnamelSample>> measure_enamel(const EnamelScene& scene,
                                                 const simulated::ToothLight& light,
                                                 const simulated::ToothSurface& surface,
                                                 const EnamelImages& images) {
  const simulated::Chip chip(images.sensor.chip);
  const simulated::Chip::Light parts{light.image(surface), light.room_image()};
  std::vector<EnamelSample> samples;
  for (int i = 0; i < images.count; ++i) {
    const cv::Mat image =
        chip.read_out(parts, {.seed = images.seed, .stream = static_cast<std::uint64_t>(i)});
    if (auto measured = measure_image(image, scene, images, samples); !measured)
      return tl::unexpected(measured.error());
  }
  return samples;
}

}  // namespace flytri::lab
