#include "hw/design/unique_areas.h"

#include <algorithm>
#include <array>
#include <limits>

#include "hw/simulated/optics/line_position.h"

namespace flytri::design {
namespace {

using simulated::ProjectorModel;
using simulated::SensorLayout;
using simulated::SensorModel;

constexpr int kImageRows = 7;

// Where a line is seen at the near end, in the middle and at the far end of the volume.
struct LineMotion {
  double near_px, middle_px, far_px;
  [[nodiscard]] double least() const { return std::min(near_px, far_px); }
  [[nodiscard]] double most() const { return std::max(near_px, far_px); }
};

void take_row(const SensorModel& sensor, const ProjectorModel& projector, double row_px,
              double depth_mm, UniqueAreas& areas) {
  const auto seen = [&](double across) {
    return LineMotion{across_in_row(sensor, projector, across, row_px, -0.5 * depth_mm),
                      across_in_row(sensor, projector, across, row_px, 0.0),
                      across_in_row(sensor, projector, across, row_px, 0.5 * depth_mm)};
  };
  LineMotion before = seen(projector.line_across.front());
  areas.motion_px = std::max(areas.motion_px, before.most() - before.least());
  for (std::size_t n = 1; n < projector.line_across.size(); ++n) {
    const LineMotion line = seen(projector.line_across[n]);
    areas.motion_px = std::max(areas.motion_px, line.most() - line.least());
    areas.spacing_px = std::min(areas.spacing_px, line.middle_px - before.middle_px);
    areas.gap_px = std::min(areas.gap_px, line.least() - before.most());
    before = line;
  }
}

}  // namespace

UniqueAreas unique_areas(const SensorModel& sensor, Pattern pattern, double depth_mm) {
  const ImageSize& size = sensor.camera.size;
  const int rows = pattern == Pattern::kVertical ? size.height_px : size.width_px;
  const int width = pattern == Pattern::kVertical ? size.width_px : size.height_px;
  // A single line has the whole image.
  UniqueAreas areas{static_cast<double>(width), 0.0, static_cast<double>(width)};
  for (int i = 0; i < kImageRows; ++i)
    take_row(sensor, sensor.projector(pattern), (i + 0.5) * rows / kImageRows, depth_mm, areas);
  return areas;
}

double largest_depth_mm(const SensorModel& sensor, Pattern pattern) {
  double low = 0.0;
  double high = 1.5 * sensor.camera.center().norm();
  for (int step = 0; step < 24; ++step) {
    const double middle = 0.5 * (low + high);
    (unique_areas(sensor, pattern, middle).gap_px >= kLeastGap_px ? low : high) = middle;
  }
  return low;
}

int most_lines(const SensorLayout& layout, Pattern pattern) {
  // The gap falls with the number of lines.
  int low = 1;
  int high = 200;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    SensorLayout tried = layout;
    tried.line_counts[static_cast<std::size_t>(pattern)] = middle;
    const SensorModel sensor = make_sensor(tried);
    const double gap_px = unique_areas(sensor, pattern, layout.volume_mm.z()).gap_px;
    (gap_px >= kLeastGap_px ? low : high) = middle;
  }
  return low;
}

}  // namespace flytri::design
