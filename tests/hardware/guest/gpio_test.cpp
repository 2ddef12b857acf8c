// Tests the lights on USB GPIO chips with the kernel drivers ftdi_sio and hid-mcp2221, on devices
// emulated by flytri_usb_devices.

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "hw/device/clock.h"
#include "hw/gpio/gpio_chips.h"
#include "hw/gpio/gpio_light_switch.h"
#include "tests/hardware/guest/camera_reader.h"
#include "tests/hardware/guest/usb_bench.h"

namespace flytri {
namespace {

using ::testing::HasSubstr;
using testing::lit_pins;
using testing::send_command;
using testing::wait_until;

constexpr unsigned kDarkPins = 0;
constexpr unsigned kVerticalPins = 1;
constexpr unsigned kHorizontalPins = 2;
constexpr unsigned kFlashPins = 4;
const char* const kFtdi = "ftdi-cbus";
const char* const kMcp = "mcp2221_gpio";

// With limits that these tests never reach; light_limits_test.cpp tests the limits.
gpio::LightWiring wiring(const char* label) {
  constexpr device::LightLimit kLong = {60.0, 0.95};
  return {{label, "", ""}, {"", 0}, {"", 1}, gpio::LineMatch{"", 2}, {kLong, kLong, kLong}};
}

std::unique_ptr<gpio::GpioLightSwitch> make_switch(const gpio::LightWiring& wiring) {
  return std::move(*gpio::GpioLightSwitch::create(wiring));
}

class GpioTest : public ::testing::Test {
 protected:
  GpioTest() { testing::restore_all(); }

  // Requests a light and waits until the request was carried out.
  static void turn_on(gpio::GpioLightSwitch& lights, device::Light light) {
    const auto before = lights.status().switched;
    ASSERT_GT(lights.post({light, 0.0}), 0);
    wait_until([&] { return lights.status().switched > before; });
  }
};

TEST_F(GpioTest, TurnsOnOneLightAtATimeOnBothChips) {
  for (const char* label : {kFtdi, kMcp}) {
    SCOPED_TRACE(label);
    const auto lights = make_switch(wiring(label));
    const auto started = lights->start();
    ASSERT_TRUE(started) << started.error().message;
    EXPECT_EQ(lit_pins(), kDarkPins);
    for (const auto& [light, pins] :
         {std::pair{device::Light::kVertical, kVerticalPins},
          std::pair{device::Light::kHorizontal, kHorizontalPins},
          std::pair{device::Light::kFlash, kFlashPins}, std::pair{device::Light::kDark, kDarkPins},
          std::pair{device::Light::kVertical, kVerticalPins}}) {
      ASSERT_NO_FATAL_FAILURE(turn_on(*lights, light));
      EXPECT_EQ(lit_pins(), pins);
    }
    lights->stop();
    EXPECT_EQ(lit_pins(), kDarkPins);
  }
}

TEST_F(GpioTest, InvertsActiveLowLines) {
  gpio::LightWiring inverted = wiring(kFtdi);
  inverted.vertical.active_low = true;
  inverted.flash.reset();
  const auto lights = make_switch(inverted);
  ASSERT_TRUE(lights->start());
  EXPECT_EQ(lit_pins(), kVerticalPins);  // the inverted line is high while dark
  ASSERT_NO_FATAL_FAILURE(turn_on(*lights, device::Light::kVertical));
  EXPECT_EQ(lit_pins(), kDarkPins);
  ASSERT_NO_FATAL_FAILURE(turn_on(*lights, device::Light::kHorizontal));
  EXPECT_EQ(lit_pins(), kVerticalPins | kHorizontalPins);
  lights->stop();
  EXPECT_EQ(lit_pins(), kVerticalPins);
}

TEST_F(GpioTest, RefusesAChipInUseAndReportsTheUser) {
  const auto holder = make_switch(wiring(kFtdi));
  ASSERT_TRUE(holder->start());
  const auto second = make_switch(wiring(kFtdi));
  const auto refused = second->start();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(refused.error().message, HasSubstr("held by flytri"));
}

TEST_F(GpioTest, ReportsMissingPermissions) {
  const auto check = [] {
    if (setuid(65534) != 0) std::_Exit(2);
    const auto refused = make_switch(wiring(kFtdi))->start();
    const bool named = !refused && refused.error().code == ErrorCode::kNotPermitted;
    std::_Exit(named ? 0 : 1);
  };
  EXPECT_EXIT(check(), ::testing::ExitedWithCode(0), "");
}

TEST_F(GpioTest, ReconnectsUnderAnotherNumberAndRestoresTheLight) {
  const auto lights = make_switch(wiring(kFtdi));
  ASSERT_TRUE(lights->start());
  ASSERT_NO_FATAL_FAILURE(turn_on(*lights, device::Light::kVertical));
  const std::string node_before = gpio::find_chip(gpio::list_chips(), {kFtdi, "", ""})->device.node;
  send_command("unplug ftdi");
  wait_until([&] { return lights->status().state == device::LightSwitchState::kLost; });
  EXPECT_EQ(lit_pins(), kDarkPins);
  lights->post({device::Light::kHorizontal, 0.0});
  // The other chip gets the number of the first.
  send_command("unplug mcp");
  wait_until([] { return device::list_device_nodes("gpio").empty(); });
  send_command("plug mcp");
  wait_until([] { return device::list_device_nodes("gpio").size() == 1; }, testing::kPlugging_s);
  send_command("plug ftdi");
  wait_until([&] { return lights->status().returned == 1; });
  wait_until([] { return lit_pins() == kHorizontalPins; });
  ASSERT_NO_FATAL_FAILURE(turn_on(*lights, device::Light::kFlash));
  EXPECT_EQ(lit_pins(), kFlashPins);
  EXPECT_NE(gpio::find_chip(gpio::list_chips(), {kFtdi, "", ""})->device.node, node_before);
  EXPECT_EQ(lights->status().lost, 1);
  EXPECT_EQ(lights->status().state, device::LightSwitchState::kRunning);
}

// As in a scan, each frame requests the other light. A chip that blocks for twelve seconds per
// command must neither cost frames nor delay the caller.
TEST_F(GpioTest, AMuteChipBlocksNeitherTheCallerNorTheCamera) {
  const auto lights = make_switch(wiring(kMcp));
  ASSERT_TRUE(lights->start());
  ASSERT_NO_FATAL_FAILURE(turn_on(*lights, device::Light::kVertical));
  device::CameraSettings settings;
  settings.size = {320, 240};
  settings.rate_hz = 25.0;
  testing::CameraReader reader({"", "M0001", ""}, settings);
  ASSERT_NO_FATAL_FAILURE(reader.start());
  send_command("mute mcp");
  const device::Clock clock = device::machine_clock();
  double slowest_post_s = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double before_s = clock.now_s();
    lights->post({i % 2 == 0 ? device::Light::kHorizontal : device::Light::kVertical, 0.0});
    slowest_post_s = std::max(slowest_post_s, clock.now_s() - before_s);
    ASSERT_NO_FATAL_FAILURE(reader.read(1));
  }
  EXPECT_LT(slowest_post_s, 0.01);
  EXPECT_EQ(reader.camera().status().dropped, 0);
  EXPECT_THAT(lights->status().message, HasSubstr("has not answered"));
  send_command("unmute mcp");
  // The last request is carried out when the unanswered call has ended.
  wait_until([&] { return lights->status().switched == 3; }, 60.0);
  EXPECT_EQ(lit_pins(), kVerticalPins);
  EXPECT_GT(lights->status().slowest_s, 4.0);
  EXPECT_EQ(lights->status().skipped, 48);
}

// A folder of images for the camera; each light has one brightness.
class LitPictures {
 public:
  static constexpr int kVerticalGrey = 200;
  static constexpr int kHorizontalGrey = 100;
  explicit LitPictures(const ImageSize& size) {
    std::filesystem::create_directory(kFolder);
    write("0_vertical.grey", std::string(size.width_px * size.height_px, char(kVerticalGrey)));
    write("0_horizontal.grey", std::string(size.width_px * size.height_px, char(kHorizontalGrey)));
  }
  ~LitPictures() { std::filesystem::remove_all(kFolder); }

 private:
  static constexpr const char* kFolder = "/tmp/pictures";
  static void write(const char* name, const std::string& bytes) {
    std::ofstream(std::filesystem::path(kFolder) / name, std::ios::binary) << bytes;
  }
};

// A frame exposed between two light changes shows only that light.
TEST_F(GpioTest, FramesShowTheLightOfTheirExposure) {
  device::CameraSettings settings;
  settings.size = {320, 240};
  settings.rate_hz = 25.0;
  settings.exposure_s = 0.01;
  const LitPictures pictures(settings.size);
  testing::CameraReader reader({"", "M0001", ""}, settings);
  ASSERT_NO_FATAL_FAILURE(reader.start());
  const auto lights = make_switch(wiring(kFtdi));
  ASSERT_TRUE(lights->start());
  for (int i = 0; i < 20; ++i) {
    const bool vertical = i % 2 == 0;
    ASSERT_NO_FATAL_FAILURE(
        turn_on(*lights, vertical ? device::Light::kVertical : device::Light::kHorizontal));
    // Frames that wait in the queue, and the one that was being exposed, may show another light.
    const double later_s = device::machine_clock().now_s() + 2.0 / settings.rate_hz;
    ASSERT_NO_FATAL_FAILURE(reader.read_until([&](const device::CameraStatus&) {
      return !reader.frames().empty() && reader.frames().back().time_s > later_s;
    }));
    EXPECT_EQ(reader.last_image().at<std::uint8_t>(120, 160),
              vertical ? LitPictures::kVerticalGrey : LitPictures::kHorizontalGrey);
  }
}

// Ends a program while a light is on.
void end_with_light_on(const char* label, const std::function<void()>& end) {
  const pid_t program = fork();
  ASSERT_GE(program, 0);
  if (program == 0) {
    setpgid(0, 0);
    const auto lights = make_switch(wiring(label));
    if (!lights->start()) std::_Exit(1);
    lights->post({device::Light::kVertical, 0.0});
    wait_until([&] { return lights->status().switched == 1; });
    end();
  }
  wait_until([] { return lit_pins() == kVerticalPins; });
  int status = 0;
  waitpid(program, &status, 0);
  wait_until([] { return lit_pins() == kDarkPins; });
}

TEST_F(GpioTest, LightsTurnDarkWhenTheProgramCrashesOrIsKilled) {
  // A signal to the whole process group, as from the terminal, also reaches the guard.
  const auto interrupt_group = [] {
    kill(0, SIGINT);
    pause();
  };
  for (const char* label : {kFtdi, kMcp}) {
    SCOPED_TRACE(label);
    end_with_light_on(label, [] { raise(SIGKILL); });
    end_with_light_on(label, [] { std::abort(); });
    end_with_light_on(label, [] { raise(SIGSEGV); });
    end_with_light_on(label, [] { std::_Exit(0); });
    end_with_light_on(label, interrupt_group);
  }
}

TEST_F(GpioTest, StopEndsTheGuard) {
  const auto lights = make_switch(wiring(kFtdi));
  ASSERT_TRUE(lights->start());
  ASSERT_NO_FATAL_FAILURE(turn_on(*lights, device::Light::kVertical));
  lights->stop();
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child process is left
  // All lines are free.
  for (const gpio::GpioChip& chip : gpio::list_chips())
    for (const gpio::GpioLine& line : chip.lines) EXPECT_EQ(line.consumer, "");
}

}  // namespace
}  // namespace flytri
