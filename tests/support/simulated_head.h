/// @file  The head of a sensor that nobody has set up yet: cameras and a light switch, with lamps
/// at some lines of its chip. Nothing says which is which.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hw/setup/setup_machine.h"
#include "hw/simulated/devices/simulated_lights.h"
#include "tests/support/manual_clock.h"

namespace flytri::testing {

/// A lamp at a line of the chip.
struct HeadLamp {
  device::Light light = device::Light::kDark;
  bool is_active_low = false;
  double brightness = 1.0;  ///< 1: lines at 120 of 255 with 10 ms
};

struct HeadCamera {
  device::CameraDescription description;
  bool is_covered = false;
};

class SimulatedHead {
 public:
  SimulatedHead();

  [[nodiscard]] setup::SetupMachine machine();
  /// Modes of a monochrome or a color camera at 256 x 192.
  static device::CameraDescription camera_named(const std::string& name, const std::string& serial,
                                                const std::vector<std::string>& formats);

  ManualClock clock;
  std::vector<HeadCamera> cameras;
  std::vector<gpio::GpioChip> chips;
  std::map<int, HeadLamp> lamps;  ///< by line
  bool has_genicam = false;       ///< its cameras are reached by that driver
  rig::RigSettings opened;        ///< the last rig that ran
  double room = 12.0;             ///< gray value without lights, of 255
  std::shared_ptr<simulated::SimulatedLights> lights;

 private:
  class Driver;
  class HeadStream;
  [[nodiscard]] std::shared_ptr<device::Camera> make_camera(const device::CameraMatch& match,
                                                            const device::CameraSettings& settings,
                                                            const gpio::LightWiring& wiring);
  [[nodiscard]] const HeadCamera* find(const device::CameraMatch& match) const;
  [[nodiscard]] cv::Mat image(const HeadCamera& camera, const device::CameraSettings& settings,
                              const gpio::LightWiring& wiring, device::Light requested) const;
  [[nodiscard]] bool shines(int line, const HeadLamp& lamp, const gpio::LightWiring& wiring,
                            device::Light requested) const;
};

/// Gives the suggested answer, unless a test has another one for a question with certain words.
class ScriptedTalk final : public setup::SetupTalk {
 public:
  /// @return  index of the answer; nothing: stop
  using Answer = std::function<std::optional<std::size_t>(std::size_t suggested)>;

  void tell(const std::string& text) override { told += text + "\n"; }
  std::optional<std::size_t> choose(const std::string& question,
                                    const std::vector<std::string>& answers,
                                    std::size_t suggested) override;
  void on(const std::string& words, Answer answer) { answers_[words] = std::move(answer); }

  std::string told;
  std::vector<std::string> questions;

 private:
  std::map<std::string, Answer> answers_;
};

}  // namespace flytri::testing
