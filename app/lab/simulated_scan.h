/// @file  A scan with the virtual sensor, view by view, as input of the studies.
#pragma once

#include <memory>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"
#include "hw/simulated/optics/sensor_path.h"
#include "hw/simulated/optics/view_noise.h"
#include "hw/simulated/optics/view_simulator.h"

namespace flytri::lab {

struct SimulatedScanOptions {
  int view_count = 300;         ///< >= 2
  simulated::PathOptions path;  ///< its duration follows from view_count and the frame rate
  /// How the real grip differs from the planned path.
  Isometry T_path_sensor = Isometry::Identity();
  simulated::ViewNoise noise;
};

/// Views with noise, the same views without noise, and the true poses.
struct SimulatedScan {
  std::vector<std::shared_ptr<const View>> views;
  std::vector<std::shared_ptr<const View>> ideal_views;
  std::vector<Isometry> T_model_sensor;
};

/// Scans a mesh with alternating patterns.
/// @errors  as ViewSimulator::create and plan_path; kCancelled.
[[nodiscard]] Result<SimulatedScan> simulate_scan(const TriangleMesh& mesh,
                                                  const simulated::SensorModel& sensor,
                                                  const SimulatedScanOptions& options,
                                                  const Workers& workers, const Progress& progress);

/// The same along a given path; the options' own path is not used.
[[nodiscard]] Result<SimulatedScan> simulate_scan_along(const TriangleMesh& mesh,
                                                        const simulated::SensorModel& sensor,
                                                        const simulated::SensorPath& path,
                                                        const SimulatedScanOptions& options,
                                                        const Workers& workers,
                                                        const Progress& progress);

/// The registered views with their truth.
struct RegisteredTruth {
  std::vector<AlignedView> aligned;
  std::vector<std::shared_ptr<const View>> ideal;
  std::vector<Isometry> T_model_sensor;
};

/// Registers the views of a scan, without the joint refinement.
/// @errors  kInsufficient: no two views could be registered; kCancelled.
[[nodiscard]] Result<RegisteredTruth> register_scan(const SimulatedScan& scan,
                                                    const Progress& progress);

}  // namespace flytri::lab
