/// @file  Two sample jaws that bite, and scans of them from the cheek.
#pragma once

#include <array>

#include "app/lab/simulated_scan.h"

namespace flytri::lab {

struct ClosedJaws {
  TriangleMesh upper, lower;  ///< each in its own frame
  TriangleMesh closed;        ///< both in the frame of the upper jaw
  Isometry T_upper_lower = Isometry::Identity();
  std::array<Vec3, 2> ends_mm;  ///< of the arch: left and right, frame of the upper jaw
};

/// Jaws of one seed, moved together until they touch, a little shifted and turned.
/// @errors  As make_sample_jaw.
[[nodiscard]] Result<ClosedJaws> close_sample_jaws(std::uint64_t seed, const Workers& workers);

/// A scan of the closed teeth of one side, from the last molar to the canine.
/// @errors  As simulate_scan.
[[nodiscard]] Result<SimulatedScan> scan_bite(const ClosedJaws& jaws, bool is_right, int view_count,
                                              std::uint64_t seed, const Workers& workers,
                                              const Progress& progress);

}  // namespace flytri::lab
