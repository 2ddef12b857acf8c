#include "tests/hardware/scan/scan_truth.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/io/files/file_bytes.h"
#include "core/io/models/ply.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "hw/simulated/optics/lit_surface.h"

namespace flytri::scan {
namespace {

Result<void> write(const std::filesystem::path& recording, io::Truth truth,
                   const ScanPictures& pictures, const simulated::SensorModel& sensor,
                   const std::vector<simulated::Exposure>& exposures, const Workers& workers) {
  truth.mesh = "model.ply";
  if (auto written = io::write_truth(recording / "truth.json", truth); !written) return written;
  const simulated::RayScene scene(pictures.mesh());
  return io::write_ply(recording / truth.mesh, pictures.mesh(),
                       {{"lit", simulated::count_lit(scene, sensor, exposures, workers)}});
}

}  // namespace

Result<void> set_pace(const std::filesystem::path& recording, double pace, bool keeps_calibration) {
  const std::filesystem::path file = recording / "recording.json";
  const auto text = io::read_file(file);
  if (!text) return tl::unexpected(text.error());
  auto list = nlohmann::ordered_json::parse(*text);
  for (auto& frame : list.at("frames")) frame["time_s"] = pace * frame.at("time_s").get<double>();
  if (!keeps_calibration) list.erase("calibration");
  return io::write_file(file, list.dump(1) + "\n");
}

Result<void> write_scan_truth(const std::filesystem::path& recording, const ScanPictures& pictures,
                              const simulated::SensorModel& sensor, const std::vector<Shown>& shown,
                              const Workers& workers) {
  const auto recorded = io::open_recording(recording);
  if (!recorded) return tl::unexpected(recorded.error());
  io::Truth truth;
  std::vector<simulated::Exposure> exposures;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Moment& moment = pictures.moments().at(shown[i].number);
    const io::RecordedFrame& frame = recorded->frames.at(i);
    truth.poses.push_back({FrameIndex(i), frame.file, frame.time_s, moment.T_model_sensor});
    if (const auto pattern = pattern_of(shown[i].kind))
      exposures.push_back({*pattern, moment.T_model_sensor});
  }
  return write(recording, std::move(truth), pictures, sensor, exposures, workers);
}

Result<void> write_resting_truth(const std::filesystem::path& recording,
                                 const ScanPictures& pictures, const simulated::SensorModel& sensor,
                                 const Workers& workers) {
  const auto recorded = io::open_recording(recording);
  if (!recorded) return tl::unexpected(recorded.error());
  const auto first =
      std::find_if(recorded->frames.begin(), recorded->frames.end(),
                   [](const io::RecordedFrame& each) { return each.kind != FrameKind::kTexture; });
  if (first == recorded->frames.end())
    return fail(ErrorCode::kInsufficient, "{}: no frame shows lines", recording.string());
  std::vector<simulated::Exposure> exposures;
  for (const Moment& moment : pictures.moments())
    for (const Pattern pattern : {Pattern::kVertical, Pattern::kHorizontal})
      exposures.push_back({pattern, moment.T_model_sensor});
  io::Truth truth;
  truth.poses.push_back({FrameIndex(static_cast<int>(first - recorded->frames.begin())),
                         first->file, first->time_s, pictures.moments().front().T_model_sensor});
  return write(recording, std::move(truth), pictures, sensor, exposures, workers);
}

}  // namespace flytri::scan
