#include "hw/setup/run_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hw/rig/check_rig.h"
#include "hw/rig/check_streams.h"
#include "hw/rig/flash_timing.h"
#include "hw/setup/choose_cameras.h"
#include "hw/setup/choose_triggers.h"
#include "hw/setup/find_lights.h"
#include "hw/setup/set_exposures.h"

namespace flytri::setup {
namespace {

/// A rig learns its latency within two seconds, if its lights reach the image.
constexpr double kLearn_s = 10.0;
/// Afterwards, for the rates and the flash.
constexpr double kRun_s = 3.0;

bool tell_all(const std::vector<Error>& problems, const SetupContext& context) {
  for (const Error& problem : problems)
    context.talk.tell(fmt::format("To do: {}", problem.message));
  return problems.empty();
}

/// The rig as it ran, with what is wrong in words.
struct Trial {
  rig::RigStatus status;
  std::string message;
};

Result<Trial> run_rig(const rig::RigSettings& rig, const SetupContext& context) {
  auto sensor = context.machine.open_rig(rig);
  if (!sensor) return tl::unexpected(sensor.error());
  if (auto started = (*sensor)->start(); !started) return tl::unexpected(started.error());
  const device::Clock& clock = context.machine.clock;
  double end_s = clock.now_s() + kLearn_s;
  bool is_learned = false;
  while (clock.now_s() < end_s) {
    if (context.progress.cancelled()) return stopped();
    const auto frame = (*sensor)->next(0.05);
    if (!frame) return tl::unexpected(frame.error());
    if (is_learned || !(*sensor)->rig_status().measurement.is_learned) continue;
    is_learned = true;
    end_s = clock.now_s() + kRun_s;
  }
  Trial trial{(*sensor)->rig_status(), (*sensor)->status().message};
  (*sensor)->stop();
  return trial;
}

void tell_timing(const Trial& trial, bool is_triggered, const SetupContext& context) {
  const rig::RigCameraStatus& camera = trial.status.measurement;
  if (!camera.is_learned) {
    context.talk.tell("The latency of the measurement camera stayed unknown.");
  } else {
    context.talk.tell(fmt::format(
        "Measurement camera: latency {:.0f} ms; light reaches a frame for {:.1f} ms; a call to the "
        "light switch takes up to {:.1f} ms",
        1e3 * camera.latency.latency_s, 1e3 * camera.latency.window_s,
        1e3 * trial.status.lights.slowest_s));
    context.talk.tell(
        is_triggered ? "Each image sees the light of its trigger."
        : trial.status.frames_per_pattern == 1
            ? "The lights change between two frames: each frame can be used."
            : "Exposures leave no gap to change the lights: every second frame can be used. A "
              "shorter exposure needs more light.");
  }
  if (!trial.message.empty()) context.talk.tell(fmt::format("To do: {}", trial.message));
}

/// Runs the rig, and again with the patterns exchanged if its images say so.
Result<rig::RigSettings> try_out(rig::RigSettings rig, const SetupContext& context) {
  context.talk.tell("Running cameras and lights together ...");
  auto trial = run_rig(rig, context);
  if (!trial) return tl::unexpected(trial.error());
  if (trial->status.measurement.fault == sync::LightFault::kSwapped) {
    context.talk.tell(
        "The camera sees the vertical lines as horizontal: their lines of the chip are exchanged.");
    std::swap(rig.lights.vertical, rig.lights.horizontal);
    trial = run_rig(rig, context);
    if (!trial) return tl::unexpected(trial.error());
  }
  tell_timing(*trial, rig.is_triggered(), context);
  return rig;
}

/// The shortest time between flashes that keeps their limit, not below a second.
double flash_period_s(const rig::RigSettings& rig) {
  const rig::FlashCameras cameras{rig.measurement.settings, rig.texture->settings,
                                  rig.texture->readout_s};
  double period_s = rig::RigSettings().flash_period_s;
  constexpr double kLongest_s = 60.0;
  while (period_s < kLongest_s &&
         !rig::check_flash_period(period_s, cameras, rig.lights.limits.flash))
    period_s += 0.5;
  return period_s;
}

}  // namespace

Result<rig::RigSettings> run_setup(const std::string& name, const SetupContext& context) {
  const auto cameras = choose_cameras(context);
  if (!cameras) return tl::unexpected(cameras.error());
  rig::RigSettings rig;
  rig.name = name;
  rig.measurement = cameras->measurement;
  rig.texture = cameras->texture;
  auto lights = find_lights(rig.measurement, rig.texture.has_value(), context);
  if (!lights) return tl::unexpected(lights.error());
  rig.lights = *std::move(lights);
  if (!rig.lights.flash) rig.texture.reset();
  auto triggered = choose_triggers(rig, context);
  if (!triggered) return triggered;
  rig = *std::move(triggered);
  auto exposed = set_exposures(rig, context);
  if (!exposed) return exposed;
  rig = *std::move(exposed);
  if (rig.texture) rig.flash_period_s = flash_period_s(rig);
  const bool runs =
      tell_all(rig::check_rig(rig, context.machine.drivers, context.machine.list_chips()),
               context) &&
      tell_all(rig::check_streams(rig, context.machine.drivers, context.machine.clock), context);
  if (!runs) return rig;
  return try_out(rig, context);
}

}  // namespace flytri::setup
