#include "core/reduction/reduce.h"

#include <algorithm>
#include <cmath>

#include "core/base/median.h"
#include "core/reduction/cells.h"
#include "core/reduction/merge.h"
#include "core/reduction/sample_order.h"
#include "core/reduction/support.h"

namespace flytri {
namespace {

/// A cell is three camera pixels wide: half a line width of six, the middle of the paper's 4 to 9.
constexpr double kCellSpacings = 3.0;
/// A cell reaches six standard uncertainties to either side of its center, which is itself a noisy
/// sample.
constexpr double kHalfLengthSigmas = 6.0;

/// Median size of the samples' deviation.
double median_sigma_mm(std::span<const SurfaceSample> samples) {
  std::vector<float> sigmas;
  sigmas.reserve(samples.size());
  for (const SurfaceSample& s : samples) sigmas.push_back(s.deviation_mm.norm());
  return median_of(sigmas);
}

CellShape shape_of_cells(std::span<const SurfaceSample> samples, double cell_mm,
                         const ReduceOptions& options) {
  CellShape shape;
  shape.width_mm = static_cast<float>(cell_mm);
  shape.half_length_mm = static_cast<float>(
      std::max(options.half_length_cells * cell_mm, kHalfLengthSigmas * median_sigma_mm(samples)));
  shape.min_normal_cos = static_cast<float>(std::cos(options.max_normal_angle_rad));
  return shape;
}

/// Keeps the members that are supported; a cell may become empty.
Cells keep_supported(const Cells& cells, const std::vector<Support>& support) {
  Cells kept;
  kept.centers = cells.centers;
  kept.starts = {0};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const std::uint32_t i : cells.of(c)) {
      if (support[i] == Support::kSupported) kept.members.push_back(i);
    }
    kept.starts.push_back(static_cast<std::uint32_t>(kept.members.size()));
  }
  return kept;
}

PointCloud merge_cells(std::span<const SurfaceSample> samples, const Cells& cells,
                       double noise_length_samples, const Workers& workers) {
  PointCloud merged(cells.size());
  workers.for_each(
      cells.size(),
      [&](std::size_t c) {
        if (!cells.of(c).empty()) {
          merged[c] = merge_samples(samples, cells.of(c), noise_length_samples);
        }
      },
      1024);
  PointCloud points;
  points.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!cells.of(c).empty()) points.push_back(merged[c]);
  }
  return points;
}

}  // namespace

Result<void> ReduceOptions::validate() const {
  const auto bad = [](const char* name, double value, const char* range) {
    return fail(ErrorCode::kBadOption, "reduction option {} is {}, must be {}", name, value, range);
  };
  if (!(cell_mm >= 0.0)) return bad("cell_mm", cell_mm, ">= 0 (0: from the data)");
  if (!(half_length_cells > 0.0)) return bad("half_length_cells", half_length_cells, "> 0");
  if (!(max_normal_angle_rad > 0.0 && max_normal_angle_rad < 1.57)) {
    return bad("max_normal_angle_rad", max_normal_angle_rad, "above 0 and below a right angle");
  }
  if (!(outlier_sigmas > 0.0)) return bad("outlier_sigmas", outlier_sigmas, "> 0");
  if (min_support < 1) return bad("min_support", min_support, ">= 1");
  if (!(noise_length_samples > 0.0)) {
    return bad("noise_length_samples", noise_length_samples, "> 0");
  }
  return {};
}

Result<Reduction> reduce_samples(std::span<const SurfaceSample> samples,
                                 const ReduceOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  Reduction reduction;
  reduction.counts.sample_count = samples.size();
  reduction.cell_mm =
      options.cell_mm > 0.0 ? options.cell_mm : kCellSpacings * sample_spacing_mm(samples);
  if (samples.empty()) return reduction;
  if (!(reduction.cell_mm > 0.0)) {
    return fail(ErrorCode::kInsufficient,
                "no view has two of the {} samples, so their spacing is unknown: set cell_mm",
                samples.size());
  }
  const std::vector<SurfaceSample> ordered = spatially_ordered(samples, reduction.cell_mm);
  reduction.counts.isolated_count = samples.size() - ordered.size();
  if (ordered.empty()) return reduction;
  const CellShape shape = shape_of_cells(ordered, reduction.cell_mm, options);
  const Cells cells = divide_into_cells(ordered, shape, workers);
  const SupportRule rule{static_cast<float>(options.outlier_sigmas), options.min_support};
  const std::vector<Support> support = find_support(ordered, cells, shape, rule, workers);
  reduction.points =
      merge_cells(ordered, keep_supported(cells, support), options.noise_length_samples, workers);
  for (const Support s : support) {
    if (s == Support::kOutvoted) ++reduction.counts.outlier_count;
    if (s == Support::kIsolated) ++reduction.counts.isolated_count;
  }
  return reduction;
}

}  // namespace flytri
