/// @file  A whole scan of an analytic surface with known poses, and pose errors to begin from.
#pragma once

#include <vector>

#include "core/geometry/view.h"
#include "tests/support/wavy_scene.h"

namespace flytri::testing {

/// Views and where they truly are; world is the frame of the first view.
struct TrueScan {
  std::vector<AlignedView> views;
};

/// A sensor wandering over the cusped surface, alternately vertical and horizontal.
[[nodiscard]] TrueScan scan_cusps(int view_count, const SceneSensor& sensor, std::uint64_t seed);

/// Every pose but the first moved by a random walk that ends about `end_mm` away, as drift does.
[[nodiscard]] std::vector<AlignedView> with_drift(const std::vector<AlignedView>& truth,
                                                  double end_mm, std::uint64_t seed);

/// RMS displacement of the points of `views` from where `truth` has them, mm, world frames as they
/// stand.
[[nodiscard]] double displacement_rms_mm(const std::vector<AlignedView>& views,
                                         const std::vector<AlignedView>& truth);

}  // namespace flytri::testing
