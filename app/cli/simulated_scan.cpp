#include "app/cli/simulated_scan.h"

namespace flytri::cli {

Result<SimulatedScan> simulate_scan(const TriangleMesh& mesh, const SensorModel& sensor,
                                    const SimulatedScanOptions& options, const Workers& workers,
                                    const Progress& progress) {
  const auto simulator = ViewSimulator::create(mesh, sensor);
  if (!simulator) return tl::unexpected(simulator.error());
  PathOptions path_options = options.path;
  path_options.duration_s = options.view_count * sensor.frame_period_s;
  const auto path = plan_path(simulator->scene(), sensor, path_options);
  if (!path) return tl::unexpected(path.error());
  const auto count = static_cast<std::size_t>(options.view_count);
  SimulatedScan scan;
  scan.views.resize(count);
  scan.ideal_views.resize(count);
  scan.T_model_sensor.resize(count);
  progress.begin_stage("Scanning", count);
  workers.for_each(count, [&](std::size_t i) {
    if (progress.cancelled()) return;
    const double time_s = path->start_s() + static_cast<double>(i) * sensor.frame_period_s;
    const Pattern pattern = i % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
    scan.T_model_sensor[i] = path->T_model_sensor(time_s);
    View ideal = simulator->trace(pattern, scan.T_model_sensor[i]);
    ideal.frame = FrameIndex(i);
    ideal.time_s = time_s;
    scan.views[i] = std::make_shared<const View>(add_noise(ideal, options.noise, i));
    scan.ideal_views[i] = std::make_shared<const View>(std::move(ideal));
    progress.advance();
  });
  if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped while scanning");
  return scan;
}

}  // namespace flytri::cli
