#include "app/lab/reconstructed_scan.h"

#include <algorithm>

#include "core/evaluation/best_fit.h"
#include "core/evaluation/surface_error.h"

namespace flytri::lab {

Result<ReconstructedScan> reconstruct_scan(const SimulatedScan& scan, const TriangleMesh& model,
                                           std::optional<JawKind> jaw, const Workers& workers,
                                           const Progress& progress) {
  reconstruct::ReconstructOptions options;
  options.finish.jaw = jaw;
  auto made = reconstruct::reconstruct_views(scan.views, options, workers, progress);
  if (!made) return tl::unexpected(made.error());
  ReconstructedScan result;
  result.surface = std::move(made->surface.mesh);
  result.spans = std::move(made->spans);
  const auto first = std::find_if(made->frames.begin(), made->frames.end(), [](const auto& frame) {
    return frame.T_world_sensor.has_value();
  });
  const Isometry T_model_world =
      scan.T_model_sensor[first->frame.at()] * first->T_world_sensor->inverse();
  // The error of the first view does not count: the world is laid on the true surface.
  const auto fit = evaluation::best_fit(evaluation::transformed(result.surface, T_model_world),
                                        model, {}, workers);
  if (!fit) return tl::unexpected(fit.error());
  result.T_model_world = fit->T_truth_result * T_model_world;
  return result;
}

Result<ReconstructedScan> scan_arch(const TriangleMesh& jaw, JawKind kind, int view_count,
                                    std::uint64_t seed, const Workers& workers,
                                    const Progress& progress) {
  SimulatedScanOptions options;
  options.view_count = view_count;
  options.path.seed = options.noise.seed = seed;
  options.noise.correlation_samples = 1.5;
  auto scan = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  return reconstruct_scan(*scan, jaw, kind, workers, progress);
}

}  // namespace flytri::lab
