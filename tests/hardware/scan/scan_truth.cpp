#include "tests/hardware/scan/scan_truth.h"

#include "core/interchange/ply.h"
#include "core/interchange/recording.h"
#include "core/interchange/truth.h"
#include "hw/simulated/lit_surface.h"

namespace flytri::scan {

Result<void> write_scan_truth(const std::filesystem::path& recording, const ScanPictures& pictures,
                              const SensorModel& sensor, const std::vector<Shown>& shown,
                              const Workers& workers) {
  const auto recorded = open_recording(recording);
  if (!recorded) return tl::unexpected(recorded.error());
  Truth truth;
  truth.mesh = "model.ply";
  std::vector<Exposure> exposures;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Moment& moment = pictures.moments().at(shown[i].number);
    const RecordedFrame& frame = recorded->frames.at(i);
    truth.poses.push_back({FrameIndex(i), frame.file, frame.time_s, moment.T_model_sensor});
    if (const auto pattern = pattern_of(shown[i].kind))
      exposures.push_back({*pattern, moment.T_model_sensor});
  }
  if (auto written = write_truth(recording / "truth.json", truth); !written) return written;
  const RayScene scene(pictures.mesh());
  return write_ply(recording / truth.mesh, pictures.mesh(),
                   {{"lit", count_lit(scene, sensor, exposures, workers)}});
}

}  // namespace flytri::scan
