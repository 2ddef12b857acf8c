#include "app/lab/simulated_scan.h"

#include "core/tracking/registrar.h"

namespace flytri::lab {
namespace {

Result<SimulatedScan> scan_along(const simulated::ViewSimulator& simulator,
                                 const simulated::SensorPath& path,
                                 const SimulatedScanOptions& options, const Workers& workers,
                                 const Progress& progress) {
  const auto count = static_cast<std::size_t>(options.view_count);
  SimulatedScan scan;
  scan.views.resize(count);
  scan.ideal_views.resize(count);
  scan.T_model_sensor.resize(count);
  progress.begin_stage("Scanning", count);
  workers.for_each(count, [&](std::size_t i) {
    if (progress.cancelled()) return;
    const double time_s =
        path.start_s() + static_cast<double>(i) * simulator.sensor().frame_period_s;
    const Pattern pattern = i % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
    scan.T_model_sensor[i] = path.T_model_sensor(time_s) * options.T_path_sensor;
    View ideal = simulator.trace(pattern, scan.T_model_sensor[i]);
    ideal.frame = FrameIndex(i);
    ideal.time_s = time_s;
    scan.views[i] = std::make_shared<const View>(simulated::add_noise(ideal, options.noise, i));
    scan.ideal_views[i] = std::make_shared<const View>(std::move(ideal));
    progress.advance();
  });
  if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped while scanning");
  return scan;
}

}  // namespace

Result<SimulatedScan> simulate_scan(const TriangleMesh& mesh, const simulated::SensorModel& sensor,
                                    const SimulatedScanOptions& options, const Workers& workers,
                                    const Progress& progress) {
  const auto simulator = simulated::ViewSimulator::create(mesh, sensor);
  if (!simulator) return tl::unexpected(simulator.error());
  simulated::PathOptions path_options = options.path;
  path_options.duration_s = options.view_count * sensor.frame_period_s;
  const auto path = simulated::plan_path(simulator->scene(), sensor, path_options);
  if (!path) return tl::unexpected(path.error());
  return scan_along(*simulator, *path, options, workers, progress);
}

Result<SimulatedScan> simulate_scan_along(const TriangleMesh& mesh,
                                          const simulated::SensorModel& sensor,
                                          const simulated::SensorPath& path,
                                          const SimulatedScanOptions& options,
                                          const Workers& workers, const Progress& progress) {
  const auto simulator = simulated::ViewSimulator::create(mesh, sensor);
  if (!simulator) return tl::unexpected(simulator.error());
  return scan_along(*simulator, path, options, workers, progress);
}
Result<RegisteredTruth> register_scan(const SimulatedScan& scan, const Progress& progress) {
  auto registrar = tracking::Registrar::create();
  if (!registrar) return tl::unexpected(registrar.error());
  progress.begin_stage("Registering views", scan.views.size());
  for (const auto& view : scan.views) {
    if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped while registering");
    registrar->add(view);
    progress.advance();
  }
  RegisteredTruth truth;
  for (const tracking::RegisteredView& registered : registrar->finish()) {
    if (registered.fate == tracking::ViewFate::kRejected) continue;
    const std::size_t i = registered.view->frame.at();
    truth.aligned.push_back({registered.view, registered.T_world_sensor});
    truth.ideal.push_back(scan.ideal_views[i]);
    truth.T_model_sensor.push_back(scan.T_model_sensor[i]);
  }
  if (truth.aligned.size() >= 2) return truth;
  return fail(ErrorCode::kInsufficient, "no two of {} views could be registered",
              scan.views.size());
}

}  // namespace flytri::lab
