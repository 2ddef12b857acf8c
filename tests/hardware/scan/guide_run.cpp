#include "tests/hardware/scan/guide_run.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"
#include "core/io/recordings/recording.h"
#include "hw/shots/rig_shots.h"
#include "hw/shots/simulated_shots.h"
#include "hw/shots/verification_shots.h"
#include "tests/hardware/scan/scan_pictures.h"
#include "tests/hardware/scan/scan_truth.h"
#include "tests/hardware/scan/vm_rig.h"
#include "tests/support/sample_meshes.h"

namespace flytri::scan {
namespace {

namespace fs = std::filesystem;
using calibration::ShotKind;

/// Largest allowed ratio of the residuals: images have only 8 bits before averaging, and color
/// images are compressed.
constexpr double kAsGood = 1.2;
/// Largest allowed RMS error of the scan at best fit. Without devices it is 14 µm.
constexpr double kGoodScan_mm = 0.02;
constexpr double kMicrons = 1e3;

std::string_view file_of(ShotKind kind) {
  switch (kind) {
    case ShotKind::kDark:
      return "dark.grey";
    case ShotKind::kVertical:
    case ShotKind::kVerticalAgain:
      return "vertical.grey";
    case ShotKind::kHorizontal:
      return "horizontal.grey";
    case ShotKind::kDots:
      return "flash.grey";
    case ShotKind::kDotsTexture:
      break;
  }
  return "flash.jpg";
}

Result<void> write_exposure(const fs::path& folder, double exposure_s) {
  return io::write_file(folder / "exposure_s", fmt::format("{}\n", exposure_s));
}

/// A target or a check: images of some shots at one depth, for each averaged exposure.
struct RestingPlace {
  std::string name;
  std::vector<ShotKind> shots;
  double z_mm = 0.0;
};

std::vector<RestingPlace> resting_places(const calibration::CalibrationPlan& plan) {
  std::vector<RestingPlace> places;
  for (const calibration::Placement& placement : calibration::placements_of(plan))
    places.push_back({fmt::format("target-{}", places.size() + 1),
                      calibration::shots_of(placement.face, true), plan.z_mm[placement.plane]});
  std::size_t number = 0;
  for (const shots::VerificationPlace& place : shots::verification_places())
    places.push_back({fmt::format("check-{}", ++number),
                      {ShotKind::kVertical, ShotKind::kHorizontal},
                      place.depth_share * plan.volume.size_mm.z()});
  return places;
}

Result<void> write_resting(const fs::path& folder, const simulated::CalibrationCamera& camera,
                           const RestingPlace& place, double exposure_s) {
  if (auto made = io::create_folder(folder); !made) return made;
  std::uint64_t stream = 0;
  for (const ShotKind kind : place.shots) {
    // The second vertical shot uses the same pictures as the first.
    if (kind == ShotKind::kVerticalAgain) continue;
    for (int i = 0; i < shots::RigShotOptions().exposures; ++i) {
      const auto file = folder / fmt::format("{}_{}", i, file_of(kind));
      auto written = write_picture(file, camera.take(kind, place.z_mm, stream++));
      if (!written) return written;
    }
  }
  return write_exposure(folder, exposure_s);
}

Result<void> write_resting_places(const fs::path& folder, const Workers& workers) {
  const auto shots = shots::SimulatedShots::create(simulated::intraoral_sensor());
  if (!shots) return tl::unexpected(shots.error());
  const simulated::SensorModel& sensor = (*shots)->sensor();
  const std::vector<RestingPlace> places = resting_places(shots::plan_of(sensor, kPlanes));
  std::vector<Result<void>> done(places.size());
  workers.for_each(places.size(), [&](std::size_t i) {
    // Different seeds give each place different noise.
    const auto camera =
        simulated::CalibrationCamera::create(sensor, {.exposures = 1, .bits = 8, .seed = i + 1});
    done[i] = camera ? write_resting(folder / places[i].name, *camera, places[i], sensor.exposure_s)
                     : tl::unexpected(camera.error());
  });
  for (const Result<void>& each : done)
    if (!each) return each;
  return io::write_file(folder.parent_path() / "planes", fmt::format("{}\n", kPlanes));
}

TriangleMesh sheet() {
  return height_field({.half_width_mm = 30.0, .step_mm = 1.0}, [](double, double) { return 0.0; });
}

/// A white sheet at rest, under each light.
Result<void> write_white(const fs::path& folder, const Workers& workers) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  const simulated::PathOptions path = {
      .kind = simulated::PathKind::kFront, .up = Vec3::UnitY(), .front = -Vec3::UnitZ()};
  const auto pictures = ScanPictures::create(sheet(), sensor, path, {0.5 * path.duration_s});
  if (!pictures) return tl::unexpected(pictures.error());
  if (auto written = pictures->write(folder, workers); !written) return written;
  return write_exposure(folder, sensor.exposure_s);
}

/// A plane that turns while it comes nearer and goes away; it ends as it began.
Result<simulated::SensorPath> turning_path(int count) {
  constexpr double kAway_mm = 5.0, kTilt_rad = 0.25;
  std::vector<simulated::PathPose> poses;
  for (int i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / count;
    Twist twist;
    twist << kTilt_rad * std::sin(turn), kTilt_rad * std::cos(2.0 * turn), 0.0, 0.0, 0.0,
        kAway_mm * std::cos(turn);
    poses.push_back({static_cast<double>(i), exp_twist(twist)});
  }
  return simulated::SensorPath::from_poses(std::move(poses));
}

Result<void> write_turning(const fs::path& folder, const Workers& workers) {
  constexpr int kCount = 160;
  constexpr double kWhite = 160.0;
  if (auto made = io::create_folder(folder); !made) return made;
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  const auto simulator = simulated::ImageSimulator::create(
      sheet(), sensor, {.motion = false, .tracing = simulated::Tracing::kGrid});
  if (!simulator) return tl::unexpected(simulator.error());
  const auto path = turning_path(kCount);
  if (!path) return tl::unexpected(path.error());
  // Under the flash the sheet is white in any place.
  const ImageSize &gray = sensor.camera.size, &color = sensor.texture_camera.size;
  const cv::Mat white(gray.height_px, gray.width_px, CV_8UC1, cv::Scalar::all(kWhite)),
      white_in_color(color.height_px, color.width_px, CV_8UC3, cv::Scalar::all(kWhite));
  std::vector<Result<void>> done(kCount);
  workers.for_each(done.size(), [&](std::size_t i) {
    done[i] = write_picture(folder / fmt::format("{}_{}", i, file_of(ShotKind::kDots)), white);
    if (done[i])
      done[i] = write_picture(folder / fmt::format("{}_{}", i, file_of(ShotKind::kDotsTexture)),
                              white_in_color);
    for (const ShotKind kind : {ShotKind::kVertical, ShotKind::kHorizontal}) {
      const Pattern pattern =
          kind == ShotKind::kVertical ? Pattern::kVertical : Pattern::kHorizontal;
      const auto image = simulator->measurement_image(pattern, *path, static_cast<double>(i), i);
      if (done[i]) done[i] = write_picture(folder / fmt::format("{}_{}", i, file_of(kind)), image);
    }
  });
  for (const Result<void>& each : done)
    if (!each) return each;
  return write_exposure(folder, sensor.exposure_s);
}

Result<void> write_jaw(const fs::path& folder, const Workers& workers) {
  const ScanOptions options;
  const auto pictures = ScanPictures::create(options, workers);
  if (!pictures) return tl::unexpected(pictures.error());
  if (auto written = pictures->write(folder / "jaw", workers); !written) return written;
  const double duration_s = (options.resting + options.moving - 1) / kRate_hz;
  auto written = io::write_file(folder.parent_path() / "duration", fmt::format("{}\n", duration_s));
  if (!written) return written;
  return write_exposure(folder / "jaw", options.sensor.exposure_s);
}

struct Residual {
  const char* name;
  const char* unit;
  double rms;
};

std::array<Residual, 6> residuals_of(const calibration::Calibration& calibration) {
  const auto depth = [&](Pattern pattern) {
    return kMicrons * calibration.of(pattern).depth_residual_mm.rms;
  };
  return {Residual{"Z vertical", "µm", depth(Pattern::kVertical)},
          Residual{"Z horizontal", "µm", depth(Pattern::kHorizontal)},
          Residual{"X", "µm", kMicrons * calibration.x_mm.residual.rms},
          Residual{"Y", "µm", kMicrons * calibration.y_mm.residual.rms},
          Residual{"U", "px", calibration.texture_u_px.residual.rms},
          Residual{"V", "px", calibration.texture_v_px.residual.rms}};
}

Result<bool> is_calibration_good(const fs::path& folder) {
  const auto measured = io::read_calibration(folder / "calibration" / "calibration.json");
  if (!measured) return tl::unexpected(measured.error());
  const auto simulated = io::read_calibration(folder / "simulated" / "calibration.json");
  if (!simulated) return tl::unexpected(simulated.error());
  const auto is = residuals_of(*measured);
  const auto should = residuals_of(*simulated);
  bool is_good = true;
  for (std::size_t i = 0; i < is.size(); ++i) {
    fmt::print("{}: RMS {:.2f} {} with devices, {:.2f} without\n", is[i].name, is[i].rms,
               is[i].unit, should[i].rms);
    is_good &= is[i].rms <= kAsGood * should[i].rms;
  }
  return is_good;
}

Result<bool> is_scan_good(const fs::path& folder) {
  const auto text = io::read_file(folder / "scan.json");
  if (!text) return tl::unexpected(text.error());
  const auto fitted = nlohmann::json::parse(*text).at("best_fit");
  const auto rms_mm = fitted.at("rms_mm").get<double>();
  fmt::print("scan: RMS {:.1f} µm at best fit\n", kMicrons * rms_mm);
  return rms_mm <= kGoodScan_mm;
}

}  // namespace

Result<void> write_guide(const fs::path& folder, const Workers& workers) {
  const fs::path pictures = folder / "pictures";
  if (auto made = io::create_folder(pictures); !made) return made;
  auto written = write_resting_places(pictures, workers);
  if (written) written = write_white(pictures / "white", workers);
  if (written) written = write_turning(pictures / "plane", workers);
  return written ? write_jaw(pictures, workers) : written;
}

Result<void> write_guide_truth(const fs::path& folder, const Workers& workers) {
  const ScanOptions options;
  const auto pictures = ScanPictures::create(options, workers);
  if (!pictures) return tl::unexpected(pictures.error());
  const auto recording = io::open_recording(folder / "scan");
  if (!recording) return tl::unexpected(recording.error());
  // Without a calibration, flytri evaluate does not measure the frames, for which it needs all
  // poses.
  if (auto paced = set_pace(recording->folder, options.sensor.frame_period_s * kRate_hz, false);
      !paced)
    return paced;
  return write_resting_truth(recording->folder, *pictures, options.sensor, workers);
}

Result<void> judge_guide(const fs::path& folder) {
  const auto calibration = is_calibration_good(folder);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto scan = is_scan_good(folder);
  if (!scan) return tl::unexpected(scan.error());
  if (*calibration && *scan) return {};
  return fail(ErrorCode::kInconsistent, "what was made by the guide is not as good as it must be");
}

}  // namespace flytri::scan
