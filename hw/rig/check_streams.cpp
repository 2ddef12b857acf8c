#include "hw/rig/check_streams.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace flytri::rig {
namespace {

constexpr int kBuffers = 8;
/// Shortest wait for one camera, while the other one fills its buffers.
constexpr double kTurn_s = 0.02;
constexpr double kRateTolerance = 0.05;
/// Of the agreed rate; a second of images counts to some percent.
constexpr double kLeastShare = 0.9;
/// Share of damaged images that is worth a message.
constexpr double kManyDamaged = 0.05;

/// A running camera, and what it sent.
struct CheckedCamera {
  RigCamera wanted;
  std::unique_ptr<stream::ImageStream> stream;
  int images = 0;
  int damaged = 0;
  double first_s = 0.0;
  double last_s = 0.0;
  std::optional<Error> failure;  ///< the stream ended
};

Result<CheckedCamera> run_camera(const RigCamera& camera, const CameraDrivers& drivers) {
  auto stream = drivers.of(camera.driver)->open(camera.match, camera.settings, kBuffers);
  if (!stream) return tl::unexpected(stream.error());
  CheckedCamera checked;
  checked.wanted = camera;
  checked.stream = *std::move(stream);
  return checked;
}

void read_camera(CheckedCamera& camera, const device::Clock& clock) {
  if (camera.failure) return;
  auto taken = camera.stream->take(kTurn_s);
  if (!taken) {
    camera.failure = taken.error().error;
    return;
  }
  if (!*taken) return;
  const stream::StreamedImage& image = **taken;
  camera.last_s = image.time_s.value_or(clock.now_s());
  if (camera.images++ == 0) camera.first_s = camera.last_s;
  if (image.flagged || image.converted.outcome != stream::Conversion::kDone) ++camera.damaged;
}

std::string rates_of(const CheckedCamera& camera, const CameraDrivers& drivers) {
  stream::CameraDriver& driver = *drivers.of(camera.wanted.driver);
  const auto found = driver.find(camera.wanted.match);
  std::string rates;
  for (const device::CameraDescription& each : driver.list()) {
    if (!found || each.node != found->node) continue;
    for (const device::CameraMode& mode : each.modes) {
      if (mode.format != device::to_string(camera.wanted.settings.format) ||
          mode.size != camera.wanted.settings.size)
        continue;
      for (const double rate_hz : mode.rates_hz)
        rates += fmt::format("{}{:.4g}", rates.empty() ? "" : ", ", rate_hz);
    }
  }
  return rates.empty() ? rates : " (it offers " + rates + " Hz)";
}

void judge_settings(const CheckedCamera& camera, const CameraDrivers& drivers,
                    std::vector<Error>& problems) {
  const device::CameraSettings agreed = camera.stream->read_back();
  const std::string name = camera.stream->label();
  const double wanted_hz = camera.wanted.settings.rate_hz;
  if (std::abs(agreed.rate_hz - wanted_hz) > kRateTolerance * wanted_hz)
    problems.push_back({ErrorCode::kBadOption,
                        fmt::format("camera {} runs at {:.4g} Hz instead of {:.4g} Hz: choose "
                                    "another rate_hz, size_px or format in rig.json{}",
                                    name, agreed.rate_hz, wanted_hz, rates_of(camera, drivers))});
  if (agreed.exposure_s && *agreed.exposure_s * agreed.rate_hz > 1.0)
    problems.push_back(
        {ErrorCode::kBadOption,
         fmt::format("camera {}: exposure_s is {:.4g}, longer than a frame at {:.4g} Hz: choose a "
                     "shorter one in rig.json, at most {:.4g}",
                     name, *agreed.exposure_s, agreed.rate_hz, 1.0 / agreed.rate_hz)});
}

void judge_images(const CheckedCamera& camera, std::vector<Error>& problems) {
  const std::string name = camera.stream->label();
  if (camera.failure) return problems.push_back(*camera.failure);
  if (camera.images == 0)
    return problems.push_back(
        {ErrorCode::kNotFound,
         fmt::format("camera {} sends no images while all cameras run: connect it to another USB "
                     "socket, choose a smaller size_px, or reload its driver with \"sudo modprobe "
                     "-r uvcvideo; sudo modprobe uvcvideo quirks=0x80\"",
                     name)});
  const double agreed_hz = camera.stream->read_back().rate_hz;
  const double rate_hz = (camera.images - 1) / std::max(camera.last_s - camera.first_s, 1e-9);
  if (camera.images > 2 && rate_hz < kLeastShare * agreed_hz)
    problems.push_back(
        {ErrorCode::kBadOption,
         fmt::format("camera {} sends {:.1f} images per second instead of {:.4g}: choose a shorter "
                     "exposure_s, a smaller size_px or a lower rate_hz in rig.json, or connect the "
                     "cameras to different USB controllers",
                     name, rate_hz, agreed_hz)});
  if (camera.damaged > kManyDamaged * camera.images)
    problems.push_back({ErrorCode::kInconsistent,
                        fmt::format("camera {}: {} of {} images are damaged: use a short cable "
                                    "without a hub, or another USB socket",
                                    name, camera.damaged, camera.images)});
}

}  // namespace

std::vector<Error> check_streams(const RigSettings& settings, const CameraDrivers& drivers,
                                 const device::Clock& clock, double duration_s) {
  const RigSettings rig = settings.free_running();
  std::vector<const RigCamera*> wanted = {&rig.measurement};
  if (rig.texture) wanted.push_back(&*rig.texture);
  std::vector<Error> problems;
  std::vector<CheckedCamera> cameras;
  for (const RigCamera* camera : wanted) {
    auto running = run_camera(*camera, drivers);
    if (running) {
      cameras.push_back(*std::move(running));
      continue;
    }
    Error problem = running.error();
    if (!cameras.empty())
      problem.message =
          fmt::format("while camera {} runs: {}", cameras[0].stream->label(), problem.message);
    problems.push_back(std::move(problem));
  }
  const double end_s = clock.now_s() + duration_s;
  while (clock.now_s() < end_s && !cameras.empty())
    for (CheckedCamera& camera : cameras) {
      read_camera(camera, clock);
      if (camera.failure) clock.sleep_s(kTurn_s);
    }
  for (const CheckedCamera& camera : cameras) {
    judge_settings(camera, drivers, problems);
    judge_images(camera, problems);
  }
  return problems;
}

}  // namespace flytri::rig
