#include "tests/support/simulated_head.h"

#include <algorithm>

#include "hw/rig/open_rig.h"
#include "hw/simulated/devices/simulated_camera.h"
#include "tests/support/simulated_rig.h"

namespace flytri::testing {
namespace {

constexpr double kUsualExposure_s = 0.01;

std::vector<std::pair<device::Light, gpio::LineMatch>> lines_of(const gpio::LightWiring& wiring) {
  std::vector<std::pair<device::Light, gpio::LineMatch>> lines = {
      {device::Light::kVertical, wiring.vertical}, {device::Light::kHorizontal, wiring.horizontal}};
  if (wiring.flash) lines.emplace_back(device::Light::kFlash, *wiring.flash);
  return lines;
}

}  // namespace

/// The simulated camera as a driver's stream.
class SimulatedHead::HeadStream final : public stream::ImageStream {
 public:
  explicit HeadStream(std::shared_ptr<device::Camera> camera)
      : camera_(std::move(camera)), settings_(camera_->read_back()) {
    (void)camera_->start();
  }
  ~HeadStream() override { camera_->stop(); }

  tl::expected<std::optional<stream::StreamedImage>, stream::StreamEnd> take(
      double timeout_s) override {
    const auto frame = camera_->next(timeout_s);
    if (!frame) return tl::unexpected(stream::StreamEnd{false, frame.error()});
    if (!*frame) return std::nullopt;
    stream::StreamedImage image;
    image.converted.image = (*frame)->image;
    image.time_s = (*frame)->time_s;
    return image;
  }
  [[nodiscard]] const device::CameraSettings& read_back() const override { return settings_; }
  [[nodiscard]] std::string name() const override { return camera_->name(); }
  [[nodiscard]] std::string label() const override { return camera_->name(); }

 private:
  const std::shared_ptr<device::Camera> camera_;
  const device::CameraSettings settings_;
};

class SimulatedHead::Driver final : public stream::CameraDriver {
 public:
  explicit Driver(SimulatedHead* head) : head_(head) {}

  std::vector<device::CameraDescription> list() override {
    std::vector<device::CameraDescription> all;
    if (head_ == nullptr) return all;
    for (const HeadCamera& camera : head_->cameras) all.push_back(camera.description);
    return all;
  }
  Result<stream::FoundCamera> find(const device::CameraMatch& match) override {
    const HeadCamera* camera = head_ == nullptr ? nullptr : head_->find(match);
    if (camera == nullptr) return fail(ErrorCode::kNotFound, "not exactly one camera matches");
    return stream::FoundCamera{camera->description.node, camera->description.name};
  }
  std::vector<Error> check(const device::CameraMatch& match,
                           const device::CameraSettings& /*settings*/) override {
    const auto found = find(match);
    if (!found) return {found.error()};
    return {};
  }
  Result<std::unique_ptr<stream::ImageStream>> open(const device::CameraMatch& match,
                                                    const device::CameraSettings& settings,
                                                    int /*buffers*/) override {
    if (auto found = find(match); !found) return tl::unexpected(found.error());
    return std::make_unique<HeadStream>(head_->make_camera(match, settings, {}));
  }

 private:
  SimulatedHead* head_;
};

SimulatedHead::SimulatedHead()
    : lights(std::make_shared<simulated::SimulatedLights>(simulated::SimulatedLightsOptions{},
                                                          clock.clock())) {
  cameras = {{camera_named("Color", "", {"MJPG", "YUYV"})}, {camera_named("Mono", "17", {"GREY"})}};
  gpio::GpioChip chip;
  chip.device = {"/dev/gpiochip1", "", "L1", "1-3", 0};
  chip.label = "ftdi-cbus";
  chip.lines.resize(4);
  chips = {chip};
  lamps = {{0, {device::Light::kFlash}},
           {2, {device::Light::kHorizontal}},
           {3, {device::Light::kVertical}}};
}

device::CameraDescription SimulatedHead::camera_named(const std::string& name,
                                                      const std::string& serial,
                                                      const std::vector<std::string>& formats) {
  static int count = 0;
  device::CameraDescription camera;
  camera.name = name;
  camera.serial = serial;
  camera.node = "/dev/video" + std::to_string(count++);
  camera.bus_path =
      "1-" + std::to_string(count) + " or pci-0000:00:14.0-usb-0:" + std::to_string(count) + ":1.0";
  for (const std::string& format : formats) camera.modes.push_back({format, {256, 192}, {30.0}});
  return camera;
}

setup::SetupMachine SimulatedHead::machine() {
  setup::SetupMachine machine;
  machine.drivers = {std::make_shared<Driver>(has_genicam ? nullptr : this),
                     std::make_shared<Driver>(has_genicam ? this : nullptr)};
  machine.list_chips = [this] { return chips; };
  machine.clock = clock.clock();
  machine.open = [this](const rig::RigSettings& rig) -> Result<rig::RigDevices> {
    if (auto valid = rig.validate(); !valid) return tl::unexpected(valid.error());
    rig::RigDevices devices;
    devices.measurement = make_camera(rig.measurement.match, rig.measurement.settings, rig.lights);
    if (rig.texture)
      devices.texture = make_camera(rig.texture->match, rig.texture->settings, rig.lights);
    devices.lights = lights;
    devices.clock = clock.clock();
    return devices;
  };
  machine.open_rig = [this, open = machine.open](const rig::RigSettings& rig) {
    opened = rig;
    return open(rig).and_then([&](rig::RigDevices devices) -> Result<std::shared_ptr<rig::Rig>> {
      return rig::assemble_rig(rig, std::move(devices));
    });
  };
  return machine;
}

const HeadCamera* SimulatedHead::find(const device::CameraMatch& match) const {
  const HeadCamera* found = nullptr;
  for (const HeadCamera& camera : cameras) {
    const device::CameraDescription& each = camera.description;
    const bool is_there = match.bus_path.empty() || each.bus_path.rfind(match.bus_path, 0) == 0;
    if (each.name != match.name || !is_there) continue;
    if (!match.serial.empty() && match.serial != each.serial) continue;
    if (found != nullptr) return nullptr;
    found = &camera;
  }
  return found;
}

std::shared_ptr<device::Camera> SimulatedHead::make_camera(const device::CameraMatch& match,
                                                           const device::CameraSettings& settings,
                                                           const gpio::LightWiring& wiring) {
  const HeadCamera* camera = find(match);
  simulated::SimulatedCameraOptions options;
  options.settings = settings;
  options.exposure_s = settings.exposure_s.value_or(kUsualExposure_s);
  options.name = match.name;
  return std::make_shared<simulated::SimulatedCamera>(
      options,
      [this, camera, settings, wiring](device::Light requested, double) {
        return image(*camera, settings, wiring, requested);
      },
      lights, clock.clock());
}

bool SimulatedHead::shines(int line, const HeadLamp& lamp, const gpio::LightWiring& wiring,
                           device::Light requested) const {
  bool is_high = false;
  for (const auto& [light, match] : lines_of(wiring))
    if (match.offset == line) is_high = (light == requested) != match.active_low;
  return is_high != lamp.is_active_low;
}

cv::Mat SimulatedHead::image(const HeadCamera& camera, const device::CameraSettings& settings,
                             const gpio::LightWiring& wiring, device::Light requested) const {
  cv::Mat light(192, 256, CV_32FC1, cv::Scalar(room));
  for (const auto& [line, lamp] : lamps) {
    if (!shines(line, lamp, wiring, requested)) continue;
    const cv::Mat one = striped_scene(lamp.light, 0.0) - striped_scene({}, 0.0);
    cv::scaleAdd(cv::Mat_<float>(one), lamp.brightness, light, light);
  }
  const double exposure = settings.exposure_s.value_or(kUsualExposure_s) / kUsualExposure_s;
  cv::Mat sum;
  light.convertTo(sum, CV_8U, exposure * (camera.is_covered ? 0.05 : 1.0));
  if (settings.channels == device::Channels::kGrey) return sum;
  cv::Mat color;
  cv::merge(std::vector<cv::Mat>{sum, sum, sum}, color);
  return color;
}

std::optional<std::size_t> ScriptedTalk::choose(const std::string& question,
                                                const std::vector<std::string>& /*answers*/,
                                                std::size_t suggested) {
  questions.push_back(question);
  for (const auto& [words, answer] : answers_)
    if (question.find(words) != std::string::npos) return answer(suggested);
  return suggested;
}

}  // namespace flytri::testing
