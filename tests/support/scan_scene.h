/// @file  Simulated scans of an analytic surface with true poses, and with pose errors.
#pragma once

#include <vector>

#include "core/geometry/view.h"
#include "tests/support/wavy_scene.h"

namespace flytri::testing {

/// Views with their true poses; the world frame is the frame of the first view.
struct TrueScan {
  std::vector<AlignedView> views;
};

/// A sensor that moves over the cusped surface, with alternating patterns.
/// @param speed  1: by about 1 mm from view to view
[[nodiscard]] TrueScan scan_cusps(int view_count, const SceneSensor& sensor, std::uint64_t seed,
                                  double speed = 1.0);

/// Adds drift: moves every pose except the first by a random walk that ends about `end_mm` away.
[[nodiscard]] std::vector<AlignedView> with_drift(const std::vector<AlignedView>& truth,
                                                  double end_mm, std::uint64_t seed);

/// RMS distance of the points of `views` from their true positions at best fit, mm.
[[nodiscard]] double displacement_rms_mm(const std::vector<AlignedView>& views,
                                         const std::vector<AlignedView>& truth);

/// All points of all views, world frame.
[[nodiscard]] std::vector<Vec3> placed_points_mm(const std::vector<AlignedView>& views);

}  // namespace flytri::testing
