#include "tests/hardware/scan/scan_truth.h"

#include "core/io/models/ply.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "hw/simulated/optics/lit_surface.h"

namespace flytri::scan {

Result<void> write_scan_truth(const std::filesystem::path& recording, const ScanPictures& pictures,
                              const simulated::SensorModel& sensor, const std::vector<Shown>& shown,
                              const Workers& workers) {
  const auto recorded = io::open_recording(recording);
  if (!recorded) return tl::unexpected(recorded.error());
  io::Truth truth;
  truth.mesh = "model.ply";
  std::vector<simulated::Exposure> exposures;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Moment& moment = pictures.moments().at(shown[i].number);
    const io::RecordedFrame& frame = recorded->frames.at(i);
    truth.poses.push_back({FrameIndex(i), frame.file, frame.time_s, moment.T_model_sensor});
    if (const auto pattern = pattern_of(shown[i].kind))
      exposures.push_back({*pattern, moment.T_model_sensor});
  }
  if (auto written = io::write_truth(recording / "truth.json", truth); !written) return written;
  const simulated::RayScene scene(pictures.mesh());
  return io::write_ply(recording / truth.mesh, pictures.mesh(),
                       {{"lit", simulated::count_lit(scene, sensor, exposures, workers)}});
}

}  // namespace flytri::scan
