#include "app/session/source.h"

#include <array>
#include <cmath>

#include "app/session/rig_devices.h"
#include "app/session/user_folders.h"
#include "core/base/workers.h"
#include "core/io/calibrations/recording_calibration.h"
#include "core/io/recordings/recording.h"
#include "hw/recording/replay_sensor.h"
#include "hw/rig/open_rig.h"
#include "hw/simulated/datasets/sensor_calibration.h"
#include "hw/simulated/devices/faulty_sensor.h"
#include "hw/simulated/devices/live_sensor.h"
#include "hw/simulated/optics/sensor_layout.h"
#include "ui/gpu/asset_path.h"

namespace flytri::session {
namespace {

/// Time in which the simulated hand moves over the jaw: the pace of a calm hand.
constexpr double kPathDuration_s = 60.0;

/// A recording of raw frames leaves this much of the disk to the case: some 20 minutes of views.
constexpr std::uintmax_t kLeftForScans_bytes = 2'000'000'000;

/// The mean direction that a jaw faces: its teeth point there. +Z if the model is closed or its
/// sides cancel each other.
Vec3 teeth_direction(const TriangleMesh& mesh) {
  constexpr double kLeastShare = 0.15;
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) {
      return mesh.vertices[triangle[i]].position_mm.cast<double>();
    };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const Vec3 normal = (b - a).cross(c - a);
    sum += normal;
    area += normal.norm();
  }
  if (sum.norm() < kLeastShare * area) return Vec3::UnitZ();
  return sum.normalized();
}

Result<Source> open_virtual_sensor(const SourceChoice& choice, const Progress& progress,
                                   const ui::Texts& texts) {
  if (choice.calibration) {
    return fail(
        ErrorCode::kBadOption,
        "--calibration needs --recording or --rig: the virtual sensor has its own calibration");
  }
  const Workers workers;
  const Result<TriangleMesh> mesh = load_object(choice.object, choice.sensor, workers);
  if (!mesh) return tl::unexpected(mesh.error());
  simulated::LiveSensorOptions options;
  options.sensor = simulated::make_sensor(simulated::layout_named(choice.sensor));
  options.path.duration_s = kPathDuration_s;
  std::string warning;
  if (simulated::is_face_sensor(choice.sensor)) {
    options.path.kind = simulated::PathKind::kFront;
  } else if (choice.object.mesh) {
    constexpr double kUpright = 0.9;
    const Vec3 up = options.path.up = teeth_direction(*mesh);
    if (std::abs(up.dot(options.path.front)) > kUpright) options.path.front = Vec3::UnitZ();
    if (up.z() < kUpright) {
      warning = texts.fill<ui::Text::kTeethPointAlong>(choice.object.mesh->string(), up.x(), up.y(),
                                                       up.z());
    }
  }
  // Each version of the program makes its own.
  const std::filesystem::path kept_in = cache_folder() / "calibration-" FLYTRI_VERSION;
  const auto shipped = ui::asset_path("calibrations");
  const Result<calibration::Calibration> calibration = simulated::cached_sensor_calibration(
      options.sensor, {kept_in, shipped.value_or(std::filesystem::path())}, workers, progress);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto shared = std::make_shared<const calibration::Calibration>(*calibration);
  Result<std::shared_ptr<simulated::LiveSensor>> sensor =
      simulated::LiveSensor::create(*mesh, options, shared, device::machine_clock());
  if (!sensor) return tl::unexpected(sensor.error());
  return Source{ui::SourceKind::kSimulated,
                *sensor,
                *sensor,
                shared,
                std::nullopt,
                nullptr,
                warning,
                simulated::sensor_calibration_file(options.sensor, kept_in)};
}

Result<Source> open_recording_source(const SourceChoice& choice, const ui::Texts& /*texts*/) {
  const auto recording = io::open_recording(choice.path);
  if (!recording) return tl::unexpected(recording.error());
  auto used = io::calibration_of(*recording, choice.calibration.value_or(std::filesystem::path()));
  if (!used) return tl::unexpected(used.error());
  recording::ReplayOptions options;
  options.speed = choice.replay_speed;
  options.calibration =
      std::make_shared<const calibration::Calibration>(std::move(used->calibration));
  auto sensor = recording::ReplaySensor::open(choice.path, options, device::machine_clock());
  if (!sensor) return tl::unexpected(sensor.error());
  return Source{ui::SourceKind::kRecording,
                *sensor,
                nullptr,
                (*sensor)->calibration(),
                std::nullopt,
                nullptr,
                used->warning};
}

Result<Source> open_rig_source(const SourceChoice& choice, const ui::Texts& texts) {
  const Result<rig::RigSettings> rig = chosen_rig(choice);
  if (!rig) return tl::unexpected(rig.error());
  auto sensor = rig::open_rig(*rig);
  if (!sensor) return tl::unexpected(sensor.error());
  if ((*sensor)->calibration() == nullptr) {
    return fail(ErrorCode::kBadOption, "{}",
                texts.fill<ui::Text::kRigWithoutCalibration>(choice.path.string(), "C"));
  }
  return Source{ui::SourceKind::kDevices, *sensor, nullptr, (*sensor)->calibration(),
                RigSource{*sensor, *rig}, nullptr, {},      rig->calibration.value_or("")};
}

constexpr std::array kSources = {
    SourceRow{kRecordingSource, "Replay this recording instead of using the virtual sensor",
              open_recording_source},
    SourceRow{kRigSource, "Scan with the devices that this rig.json describes", open_rig_source}};

Result<Source> open_chosen(const SourceChoice& choice, const Progress& progress,
                           const ui::Texts& texts) {
  for (const SourceRow& row : kSources) {
    if (row.name == choice.name) return row.open(choice, texts);
  }
  return open_virtual_sensor(choice, progress, texts);
}

/// Lets the frames of any source but a recording be recorded.
Result<Source> with_recorder(Source source) {
  if (source.kind == ui::SourceKind::kRecording) return source;
  recording::RecorderOptions options;
  options.is_private = true;
  options.least_free_bytes = kLeftForScans_bytes;
  auto recorder = recording::RecorderSensor::create(source.sensor, options);
  if (!recorder) return tl::unexpected(recorder.error());
  source.sensor = source.recorder = *recorder;
  return source;
}

Result<Source> with_faults(Source source, const SourceChoice& choice) {
  if (!choice.fault_seed) return source;
  simulated::FaultOptions faults;
  faults.dropped_share = faults.delayed_share = faults.unknown_share = 0.05;
  faults.lost_share = 0.01;
  faults.seed = *choice.fault_seed;
  auto faulty = simulated::FaultySensor::create(source.sensor, faults, device::machine_clock());
  if (!faulty) return tl::unexpected(faulty.error());
  source.sensor = *faulty;
  return source;
}

}  // namespace

std::span<const SourceRow> source_table() { return kSources; }

Result<Source> open_source(const SourceChoice& choice, const Progress& progress,
                           const ui::Texts& texts) {
  return open_chosen(choice, progress, texts)
      .and_then([&](Source&& source) { return with_faults(std::move(source), choice); })
      .and_then([](Source&& source) { return with_recorder(std::move(source)); });
}

}  // namespace flytri::session
