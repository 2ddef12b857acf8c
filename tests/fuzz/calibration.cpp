/// @file  Any bytes as calibration.json: the reader accepts or refuses them; with what it accepts,
/// lines can be triangulated and reduced.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/io/calibrations/calibration_json.h"
#include "core/reduction/reduce.h"
#include "core/triangulation/triangulate.h"

namespace flytri {
namespace {

/// Each line in the middle of its unique areas, as if a plane was measured.
indexing::IndexedLines middle_lines(const calibration::PatternCalibration& pattern) {
  indexing::IndexedLines lines;
  for (std::size_t n = 0; n < pattern.lines.size(); ++n) {
    indexing::IndexedTrace trace{LineIndex(n), {}};
    for (std::size_t along = 0; along < pattern.lines[n].size(); ++along) {
      const calibration::LineRow& row = pattern.lines[n][along];
      const double middle = 0.5 * (row.area_min_px + row.area_max_px);
      if (row.valid())
        trace.samples.push_back(
            {static_cast<int>(along), static_cast<float>(middle), 4.0F, 100.0F, 0.06F, false});
    }
    lines.traces.push_back(trace);
  }
  return lines;
}

void use(const calibration::Calibration& calibration) {
  std::vector<SurfaceSample> samples;
  for (const Pattern pattern : kPatterns) {
    const auto measured =
        triangulation::triangulate(middle_lines(calibration.of(pattern)), calibration, pattern, {});
    for (const Profile& profile : measured.view.profiles) {
      for (const ProfilePoint& point : profile.points)
        samples.push_back({point.position_mm.cast<float>(), -Vec3f::UnitZ(), point.deviation_mm,
                           ViewIndex(static_cast<std::size_t>(pattern))});
    }
  }
  (void)reduction::reduce_samples(samples, {}, Workers(1));
}

}  // namespace
}  // namespace flytri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto calibration = flytri::io::parse_calibration(bytes, "fuzz");
  if (calibration) flytri::use(*calibration);
  return 0;
}
