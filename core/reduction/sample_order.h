/// @file  Sorts samples into a spatial order, independent of the input order, and measures their
///          spacing.
#pragma once

#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/point_cloud.h"

namespace flytri::reduction {

/// The usable samples (finite, with a unit normal) along a space-filling curve, so that neighbors
/// in the list are near in space. The result does not depend on the order of the input.
/// @param cell_mm   > 0: resolution of the curve
/// @param progress  advanced by one step
/// @errors  kCancelled.
[[nodiscard]] Result<std::vector<SurfaceSample>> spatially_ordered(
    std::span<const SurfaceSample> samples, double cell_mm, const Workers& workers,
    const Progress& progress);

/// Median distance of a sample to the nearest sample of its view, measured perpendicular to the
/// noise direction: about the size of a camera pixel on the object. 0 if no view has two samples.
[[nodiscard]] double sample_spacing_mm(std::span<const SurfaceSample> samples);

}  // namespace flytri::reduction
