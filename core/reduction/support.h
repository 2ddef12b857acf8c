/// @file  Separates samples on the surface from outliers: other views must agree with a sample.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/point_cloud.h"
#include "core/reduction/cells.h"

namespace flytri::reduction {

enum class Support : std::uint8_t {
  kSupported,
  kOutvoted,  ///< several other views saw the surface here at another height
  kIsolated,  ///< too few samples nearby to form a surface
};

struct SupportRule {
  float outlier_sigmas = 3.5F;  ///< two samples agree if their distance along the normal is at most
                                ///< this many standard uncertainties
  int min_support = 5;          ///< number of samples, including itself, that must agree
};

/// Lets the views vote on every sample. Views count, not samples: the samples of one line err
/// together.
/// @param progress  advanced by one step
/// @errors  kCancelled.
[[nodiscard]] Result<std::vector<Support>> find_support(std::span<const SurfaceSample> samples,
                                                        const Cells& cells, const SupportRule& rule,
                                                        const Workers& workers,
                                                        const Progress& progress);

}  // namespace flytri::reduction
