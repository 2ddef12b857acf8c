#include "core/reduction/reduce.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/reduction/cells.h"
#include "core/reduction/merge.h"
#include "core/reduction/sample_order.h"
#include "core/reduction/support.h"

namespace flytri::reduction {
namespace {

/// A cell is three camera pixels wide: half of a typical line width of six pixels (4 to 9 in the
/// paper, section "Physical Optimization").
constexpr double kCellSpacings = 3.0;
/// A cell extends at least six standard uncertainties to each side of its center, which is a noisy
/// sample itself.
constexpr double kHalfLengthSigmas = 6.0;

/// A good sensor has 3; a cell as long as a hundred times its width holds no surface.
constexpr float kMaxLengthRatio = 100.0F;

/// Share of the total time of each part.
constexpr double kOrderShare = 0.2, kCellShare = 0.3, kSupportShare = 0.4, kMergeShare = 0.1;

/// Median length of the samples' deviations.
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

/// Keeps the supported samples; a cell may become empty.
Cells keep_supported(const Cells& cells, const std::vector<Support>& support) {
  Cells kept;
  kept.shape = cells.shape;
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

Result<PointCloud> merge_cells(std::span<const SurfaceSample> samples, const Cells& cells,
                               double noise_length_samples, const Workers& workers,
                               const Progress& progress) {
  const MeanVariance mean_variance(noise_length_samples);
  PointCloud merged(cells.size());
  const bool complete = workers.for_each_unless_cancelled(
      cells.size(),
      [&](std::size_t c) {
        if (!cells.of(c).empty()) {
          merged[c] = merge_samples(samples, cells.of(c), mean_variance);
        }
      },
      progress, 1024);
  if (!complete) return stopped();
  PointCloud points;
  points.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!cells.of(c).empty()) points.push_back(merged[c]);
  }
  return points;
}

/// Reduces samples in spatial order; writes points and counts to `reduction`.
Result<void> reduce_ordered(std::span<const SurfaceSample> samples, const ReduceOptions& options,
                            const Workers& workers, const Progress& progress,
                            Reduction& reduction) {
  const CellShape shape = shape_of_cells(samples, reduction.cell_mm, options);
  // Cells that all overlap would take a time that grows with the square of the samples.
  if (!(shape.half_length_mm <= kMaxLengthRatio * shape.width_mm)) {
    return fail(ErrorCode::kInconsistent,
                "the measured points are uncertain by {:.3g} mm, far more than their spacing; "
                "calibrate the sensor again",
                median_sigma_mm(samples));
  }
  const auto cells = divide_into_cells(samples, shape, workers, progress.part(kCellShare));
  if (!cells) return tl::unexpected(cells.error());
  const SupportRule rule{static_cast<float>(options.outlier_sigmas), options.min_support};
  const auto support = find_support(samples, *cells, rule, workers, progress.part(kSupportShare));
  if (!support) return tl::unexpected(support.error());
  auto points = merge_cells(samples, keep_supported(*cells, *support), options.noise_length_samples,
                            workers, progress.part(kMergeShare));
  if (!points) return tl::unexpected(points.error());
  reduction.points = std::move(*points);
  for (const Support s : *support) {
    if (s == Support::kOutvoted) ++reduction.counts.outlier_count;
    if (s == Support::kIsolated) ++reduction.counts.isolated_count;
  }
  return {};
}

}  // namespace

Result<void> ReduceOptions::validate() const {
  return OptionCheck("ReduceOptions")
      .not_negative("cell_mm", cell_mm)
      .positive("half_length_cells", half_length_cells)
      .must("max_normal_angle_rad", max_normal_angle_rad,
            max_normal_angle_rad > 0.0 && max_normal_angle_rad < 1.57,
            "above 0 and below a right angle, 1.57")
      .positive("outlier_sigmas", outlier_sigmas)
      .at_least("min_support", min_support, 1)
      .positive("noise_length_samples", noise_length_samples)
      .result();
}

Result<Reduction> reduce_samples(std::span<const SurfaceSample> samples,
                                 const ReduceOptions& options, const Workers& workers,
                                 const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  Reduction reduction;
  reduction.counts.sample_count = samples.size();
  reduction.cell_mm =
      options.cell_mm > 0.0 ? options.cell_mm : kCellSpacings * sample_spacing_mm(samples);
  if (samples.empty()) return reduction;
  if (!(reduction.cell_mm > 0.0)) {
    return fail(
        ErrorCode::kInsufficient,
        "no view has two of the {} samples, so their spacing is unknown; set the option cell_mm",
        samples.size());
  }
  const auto ordered =
      spatially_ordered(samples, reduction.cell_mm, workers, progress.part(kOrderShare));
  if (!ordered) return tl::unexpected(ordered.error());
  reduction.counts.isolated_count = samples.size() - ordered->size();
  if (ordered->empty()) return reduction;
  const auto reduced = reduce_ordered(*ordered, options, workers, progress, reduction);
  if (!reduced) return tl::unexpected(reduced.error());
  return reduction;
}

}  // namespace flytri::reduction
