#include "hw/setup/choose_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "hw/rig/check_streams.h"
#include "hw/setup/camera_modes.h"

namespace flytri::setup {
namespace {

constexpr int kBuffers = 4;
/// The driver's queue has old images, and a camera needs a moment after its start.
constexpr double kSettle_s = 0.5;
constexpr double kNoImage_s = 3.0;
/// A covered camera gets less than half of its light; the others keep more than four fifths.
constexpr double kCovered = 0.5, kNotCovered = 0.8;
/// Share of full scale below which a drop says nothing.
constexpr double kDarkRoom = 0.02;
/// Settings of the texture camera that are tried: each costs a second.
constexpr std::size_t kTries = 6;

struct Candidate {
  rig::DriverKind driver = rig::DriverKind::kV4l2;
  device::CameraDescription description;
  device::CameraMatch match;
  std::string label;
};

/// What finds this camera again: its serial number where it has one, else its USB socket.
std::optional<device::CameraMatch> match_of(const device::CameraDescription& camera,
                                            stream::CameraDriver& driver) {
  // Lists show "bus path or ID_PATH".
  const std::string socket = camera.bus_path.substr(0, camera.bus_path.find(" or "));
  const std::vector<device::CameraMatch> matches = {{camera.name, camera.serial, {}},
                                                    {camera.name, camera.serial, socket}};
  for (const device::CameraMatch& match : matches) {
    if (match.serial.empty() && match.bus_path.empty()) continue;
    const auto found = driver.find(match);
    if (found && found->node == camera.node) return match;
  }
  return std::nullopt;
}

std::vector<Candidate> find_candidates(const SetupContext& context) {
  std::vector<Candidate> candidates;
  for (const rig::DriverKind kind : {rig::DriverKind::kV4l2, rig::DriverKind::kGenicam}) {
    stream::CameraDriver& driver = *context.machine.drivers.of(kind);
    for (device::CameraDescription& camera : driver.list()) {
      for (const Error& problem : camera.problems)
        context.talk.tell(fmt::format("Not usable: {}", problem.message));
      if (!camera.problems.empty()) continue;
      if (suitable_settings(camera.modes, device::Channels::kGrey, context.rate_hz).empty()) {
        context.talk.tell(
            fmt::format("Not usable: {} offers no format that flytri reads at {:.3g} Hz or more",
                        camera.name, kSlowestShare * context.rate_hz));
        continue;
      }
      auto match = match_of(camera, driver);
      if (!match) {
        context.talk.tell(fmt::format(
            "Not usable: {} cannot be told from another camera: plug it in again", camera.name));
        continue;
      }
      std::string label =
          fmt::format("{} ({})", camera.name,
                      match->bus_path.empty() ? "serial " + match->serial : match->bus_path);
      candidates.push_back({kind, std::move(camera), *std::move(match), std::move(label)});
    }
  }
  return candidates;
}

rig::RigCamera camera_of(const Candidate& candidate, const device::CameraSettings& settings) {
  rig::RigCamera camera;
  camera.driver = candidate.driver;
  camera.match = candidate.match;
  camera.settings = settings;
  return camera;
}

rig::RigCamera best_of(const Candidate& candidate, const SetupContext& context) {
  return camera_of(candidate, suitable_settings(candidate.description.modes,
                                                device::Channels::kGrey, context.rate_hz)
                                  .front());
}

/// Mean gray value of what the camera sees now, as a share of full scale.
Result<double> brightness_of(const Candidate& candidate, const SetupContext& context) {
  const rig::RigCamera camera = best_of(candidate, context);
  auto stream =
      context.machine.drivers.of(camera.driver)->open(camera.match, camera.settings, kBuffers);
  if (!stream) return tl::unexpected(stream.error());
  const device::Clock& clock = context.machine.clock;
  const double begin_s = clock.now_s();
  std::optional<double> brightness;
  while (clock.now_s() < begin_s + (brightness ? kSettle_s : kNoImage_s)) {
    if (context.progress.cancelled()) return stopped();
    auto taken = (*stream)->take(0.05);
    if (!taken) return tl::unexpected(taken.error().error);
    if (!*taken || (*taken)->converted.outcome != stream::Conversion::kDone) continue;
    const cv::Mat& image = (*taken)->converted.image;
    brightness = cv::mean(image)[0] / (image.depth() == CV_16U ? 65535.0 : 255.0);
  }
  if (brightness) return *brightness;
  return fail(ErrorCode::kNotFound, "camera {} sends no images: connect it to another USB socket",
              candidate.label);
}

Result<std::vector<double>> brightness_of_all(const std::vector<Candidate>& cameras,
                                              const SetupContext& context) {
  std::vector<double> all;
  for (const Candidate& camera : cameras) {
    const auto brightness = brightness_of(camera, context);
    if (!brightness) return tl::unexpected(brightness.error());
    all.push_back(*brightness);
  }
  return all;
}

/// The only camera that got dark.
std::optional<std::size_t> covered_camera(const std::vector<double>& before,
                                          const std::vector<double>& after) {
  std::optional<std::size_t> covered;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] < kDarkRoom) return std::nullopt;
    const double share = after[i] / before[i];
    if (share > kNotCovered) continue;
    if (share > kCovered || covered) return std::nullopt;
    covered = i;
  }
  return covered;
}

Result<std::size_t> choose_from_list(const std::vector<Candidate>& cameras,
                                     const SetupContext& context) {
  std::vector<std::string> labels;
  labels.reserve(cameras.size());
  for (const Candidate& camera : cameras) labels.push_back(camera.label);
  const auto grey = std::find_if(cameras.begin(), cameras.end(), [](const Candidate& camera) {
    return is_monochrome(camera.description.modes);
  });
  const std::size_t suggested =
      grey == cameras.end() ? 0 : static_cast<std::size_t>(grey - cameras.begin());
  return context.choose("Which one is the measurement camera, which sees the lines?", labels,
                        suggested);
}

Result<std::size_t> find_by_hand(const std::vector<Candidate>& cameras,
                                 const SetupContext& context) {
  const auto before = brightness_of_all(cameras, context);
  if (!before) return tl::unexpected(before.error());
  std::size_t suggested = 0;
  while (true) {
    auto answer = context.choose(
        "Hold a hand right in front of the measurement camera, which sees the lines.",
        {"The hand is there", "Choose from a list instead"}, suggested);
    if (!answer) return answer;
    if (*answer == 1) return choose_from_list(cameras, context);
    const auto after = brightness_of_all(cameras, context);
    if (!after) return tl::unexpected(after.error());
    if (const auto covered = covered_camera(*before, *after)) return *covered;
    context.talk.tell(
        "No camera, or more than one, got dark. Let light fall on all cameras, and cover only "
        "one.");
    suggested = 1;
  }
}

Result<std::size_t> choose_measurement(const std::vector<Candidate>& cameras,
                                       const SetupContext& context) {
  if (cameras.size() == 1) {
    context.talk.tell(
        fmt::format("The only camera, {}, is the measurement camera.", cameras[0].label));
    return std::size_t{0};
  }
  const auto is_gray = [](const Candidate& camera) {
    return is_monochrome(camera.description.modes);
  };
  if (std::count_if(cameras.begin(), cameras.end(), is_gray) == 1) {
    const auto gray = std::find_if(cameras.begin(), cameras.end(), is_gray);
    auto answer = context.choose(
        fmt::format("Only {} is monochrome. Is it the measurement camera, which sees the lines?",
                    gray->label),
        {"Yes", "No"});
    if (!answer) return answer;
    if (*answer == 0) return static_cast<std::size_t>(gray - cameras.begin());
  }
  return find_by_hand(cameras, context);
}

Result<std::optional<std::size_t>> choose_texture(const std::vector<Candidate>& cameras,
                                                  std::size_t measurement,
                                                  const SetupContext& context) {
  std::vector<std::size_t> colored;
  std::vector<std::string> answers;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (i == measurement || is_monochrome(cameras[i].description.modes)) continue;
    colored.push_back(i);
    answers.push_back(cameras[i].label);
  }
  if (colored.empty()) {
    context.talk.tell("There is no color camera: models will have no texture.");
    return std::optional<std::size_t>();
  }
  answers.emplace_back("None: models without texture");
  const auto answer = context.choose("Which one is the texture camera, in color?", answers);
  if (!answer) return tl::unexpected(answer.error());
  if (*answer == colored.size()) return std::optional<std::size_t>();
  return std::optional(colored[*answer]);
}

/// Settings of the texture camera with which both run together; if there are none, the best ones.
rig::RigCamera run_together(const rig::RigCamera& measurement, const Candidate& texture,
                            const SetupContext& context) {
  std::vector<device::CameraSettings> settings =
      suitable_settings(texture.description.modes, device::Channels::kRgb, context.rate_hz);
  rig::RigCamera best = camera_of(texture, settings.front());
  settings.resize(std::min(settings.size(), kTries));
  std::string trouble;
  for (const device::CameraSettings& each : settings) {
    rig::RigSettings rig;
    rig.measurement = measurement;
    rig.texture = camera_of(texture, each);
    const std::vector<Error> problems =
        rig::check_streams(rig, context.machine.drivers, context.machine.clock);
    if (problems.empty()) return *rig.texture;
    if (trouble.empty()) trouble = problems.front().message;
  }
  context.talk.tell(fmt::format("The cameras do not run together: {}", trouble));
  return best;
}

}  // namespace

Result<ChosenCameras> choose_cameras(const SetupContext& context) {
  const std::vector<Candidate> cameras = find_candidates(context);
  if (cameras.empty())
    return fail(
        ErrorCode::kNotFound,
        "no camera can be used: plug one in; `flytri devices` says what is wrong with each");
  const auto measurement = choose_measurement(cameras, context);
  if (!measurement) return tl::unexpected(measurement.error());
  ChosenCameras chosen;
  chosen.measurement = best_of(cameras[*measurement], context);
  context.talk.tell(fmt::format("Measurement camera: {}, {}", cameras[*measurement].label,
                                text_of(chosen.measurement.settings)));
  const auto texture = choose_texture(cameras, *measurement, context);
  if (!texture) return tl::unexpected(texture.error());
  if (!*texture) return chosen;
  chosen.texture = run_together(chosen.measurement, cameras[**texture], context);
  context.talk.tell(fmt::format("Texture camera: {}, {}", cameras[**texture].label,
                                text_of(chosen.texture->settings)));
  return chosen;
}

}  // namespace flytri::setup
