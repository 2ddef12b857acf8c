#include "hw/gpio/gpio_light_switch.h"

#include <gmock/gmock.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "hw/device/clock.h"
#include "tests/support/fake_logind.h"

namespace flytri::gpio {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A chip controlled by the test; it exists longer than the lines.
class FakeChip {
 public:
  std::atomic<bool> plugged{true};
  std::atomic<int> error{0};
  std::atomic<int> opened{0};

  void open() {
    ++opened;
    std::unique_lock lock(mutex_);
    released_.wait(lock, [&] { return !mute_; });
  }
  void set(device::Light light) {
    std::unique_lock lock(mutex_);
    released_.wait(lock, [&] { return !mute_; });
    lights_.push_back(light);
  }
  void mute() {
    const std::lock_guard lock(mutex_);
    mute_ = true;
  }
  void answer() {
    {
      const std::lock_guard lock(mutex_);
      mute_ = false;
    }
    released_.notify_all();
  }
  std::vector<device::Light> lights() {
    const std::lock_guard lock(mutex_);
    return lights_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable released_;
  bool mute_ = false;
  std::vector<device::Light> lights_;
};

class FakeLines final : public LightLines {
 public:
  explicit FakeLines(std::shared_ptr<FakeChip> chip) : chip_(std::move(chip)) {}
  ~FakeLines() override {
    if (chip_->plugged) chip_->set(device::Light::kDark);
  }
  int set(device::Light light) override {
    if (!chip_->plugged) return ENODEV;
    if (chip_->error != 0) return chip_->error;
    chip_->set(light);
    return 0;
  }
  bool present() const override { return chip_->plugged; }

 private:
  std::shared_ptr<FakeChip> chip_;
};

class GpioLightSwitchTest : public ::testing::Test {
 protected:
  GpioLightSwitchTest() {
    const OpenLightLines open = [chip = chip_]() -> Result<std::unique_ptr<LightLines>> {
      if (!chip->plugged) return fail(ErrorCode::kNotFound, "no chip: plug it in");
      chip->open();
      return std::make_unique<FakeLines>(chip);
    };
    GpioLightSwitchOptions options;
    options.search_period_s = 0.002;
    options.slow_call_s = 0.01;
    options.limits.flash = {0.1, 0.5};
    switch_ = std::move(*GpioLightSwitch::create(open, options));
  }

  // The switch has its own thread. The limit of a minute allows for busy machines.
  void wait_until(const std::function<bool(const device::LightSwitchStatus&)>& reached) {
    const device::Clock clock = device::machine_clock();
    const double end_s = clock.now_s() + 60.0;
    while (!reached(switch_->status())) {
      ASSERT_LT(clock.now_s(), end_s);
      std::this_thread::yield();
    }
  }

  void post_and_wait(device::Light light) {
    const auto before = switch_->status().switched;
    switch_->post({light, 0.0});
    wait_until([&](const device::LightSwitchStatus& status) { return status.switched > before; });
  }

  std::shared_ptr<FakeChip> chip_ = std::make_shared<FakeChip>();
  std::unique_ptr<GpioLightSwitch> switch_;
};

TEST_F(GpioLightSwitchTest, CarriesOutRequestsAndReportsTheirTimes) {
  ASSERT_TRUE(switch_->start());
  const double before_s = device::machine_clock().now_s();
  post_and_wait(device::Light::kVertical);
  post_and_wait(device::Light::kFlash);
  const auto done = switch_->take_done();
  ASSERT_EQ(done.size(), 2U);
  EXPECT_EQ(done[0].request, 1);
  EXPECT_EQ(done[0].light, device::Light::kVertical);
  EXPECT_TRUE(done[0].accepted);
  EXPECT_LE(before_s, done[0].before_s);
  EXPECT_LE(done[0].before_s, done[0].after_s);
  EXPECT_LE(done[0].after_s, done[1].before_s);
  EXPECT_TRUE(switch_->take_done().empty());
}

TEST_F(GpioLightSwitchTest, WaitsForTheTimeOfARequest) {
  ASSERT_TRUE(switch_->start());
  const double due_s = device::machine_clock().now_s() + 0.02;
  switch_->post({device::Light::kVertical, due_s});
  wait_until([](const device::LightSwitchStatus& status) { return status.switched == 1; });
  EXPECT_GE(switch_->take_done()[0].before_s, due_s);
}

TEST_F(GpioLightSwitchTest, IsDarkAndRefusesRequestsAfterStop) {
  ASSERT_TRUE(switch_->start());
  post_and_wait(device::Light::kHorizontal);
  switch_->stop();
  EXPECT_THAT(chip_->lights(), ElementsAre(device::Light::kHorizontal, device::Light::kDark));
  EXPECT_EQ(switch_->post({device::Light::kVertical, 0.0}), 0);
  EXPECT_EQ(switch_->status().state, device::LightSwitchState::kIdle);
  ASSERT_TRUE(switch_->start());
  EXPECT_EQ(switch_->post({device::Light::kVertical, 0.0}), 1);
}

TEST_F(GpioLightSwitchTest, ABlockedChipDoesNotDelayTheCallerAndOnlyTheLastRequestIsCarriedOut) {
  ASSERT_TRUE(switch_->start());
  chip_->mute();
  switch_->post({device::Light::kVertical, 0.0});
  wait_until([](const device::LightSwitchStatus& status) { return status.slowest_s > 0.02; });
  EXPECT_THAT(switch_->status().message, HasSubstr("has not answered"));
  switch_->post({device::Light::kHorizontal, 0.0});
  switch_->post({device::Light::kFlash, 0.0});
  switch_->post({device::Light::kVertical, 0.0});
  chip_->answer();
  wait_until([](const device::LightSwitchStatus& status) { return status.switched == 2; });
  EXPECT_THAT(chip_->lights(), ElementsAre(device::Light::kVertical, device::Light::kVertical));
  EXPECT_EQ(switch_->status().skipped, 2);
  const auto done = switch_->take_done();
  ASSERT_EQ(done.size(), 2U);
  EXPECT_EQ(done[1].request, 4);
  EXPECT_GT(done[0].after_s - done[0].before_s, 0.02);
}

TEST_F(GpioLightSwitchTest, DetectsUnpluggingWhileIdleAndRestoresTheLight) {
  ASSERT_TRUE(switch_->start());
  post_and_wait(device::Light::kVertical);
  chip_->plugged = false;
  wait_until([](const device::LightSwitchStatus& s) {
    return s.state == device::LightSwitchState::kLost;
  });
  EXPECT_EQ(switch_->status().lost, 1);
  switch_->post({device::Light::kHorizontal, 0.0});
  wait_until([](const device::LightSwitchStatus& status) { return status.skipped == 1; });
  chip_->plugged = true;
  wait_until([](const device::LightSwitchStatus& status) { return status.switched == 2; });
  EXPECT_EQ(switch_->status().returned, 1);
  EXPECT_EQ(switch_->status().state, device::LightSwitchState::kRunning);
  EXPECT_THAT(chip_->lights(), ElementsAre(device::Light::kVertical, device::Light::kHorizontal));
}

TEST_F(GpioLightSwitchTest, TurnsOnNoLightIfTheChipIsBackAfterStop) {
  ASSERT_TRUE(switch_->start());
  post_and_wait(device::Light::kVertical);
  chip_->plugged = false;
  wait_until([](const device::LightSwitchStatus& s) {
    return s.state == device::LightSwitchState::kLost;
  });
  chip_->mute();
  chip_->plugged = true;
  wait_until([&](const device::LightSwitchStatus&) { return chip_->opened == 2; });
  std::thread stopping([&] { switch_->stop(); });
  wait_until([&](const device::LightSwitchStatus&) {
    return switch_->post({device::Light::kVertical, 0.0}) == 0;
  });
  chip_->answer();
  stopping.join();
  EXPECT_THAT(chip_->lights(), ElementsAre(device::Light::kVertical, device::Light::kDark));
}

TEST_F(GpioLightSwitchTest, ReportsARefusedRequestAndReopensTheChip) {
  ASSERT_TRUE(switch_->start());
  chip_->error = EIO;
  switch_->post({device::Light::kVertical, 0.0});
  wait_until([](const device::LightSwitchStatus& status) { return status.refused >= 1; });
  chip_->error = 0;
  wait_until([](const device::LightSwitchStatus& status) { return status.switched == 1; });
  EXPECT_FALSE(switch_->take_done()[0].accepted);
}

// The caller hangs: it requests a light and nothing more.
TEST_F(GpioLightSwitchTest, ALightThatStaysOnForTooLongTurnsDarkAndRests) {
  ASSERT_TRUE(switch_->start());
  post_and_wait(device::Light::kFlash);
  const double on_s = switch_->take_done()[0].before_s;
  wait_until([](const device::LightSwitchStatus& status) { return status.limited == 1; });
  wait_until([](const device::LightSwitchStatus& status) { return status.switched == 2; });
  EXPECT_THAT(chip_->lights(), ElementsAre(device::Light::kFlash, device::Light::kDark));
  const auto done = switch_->take_done();
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].light, device::Light::kDark);
  EXPECT_EQ(done[0].request, 1);
  EXPECT_GE(done[0].before_s - on_s, 0.09);
  EXPECT_THAT(switch_->status().message, HasSubstr("max_on_s"));
}

TEST_F(GpioLightSwitchTest, ARestingLightStaysDarkWhateverIsRequested) {
  ASSERT_TRUE(switch_->start());
  post_and_wait(device::Light::kFlash);
  wait_until([](const device::LightSwitchStatus& status) { return status.switched == 2; });
  post_and_wait(device::Light::kFlash);
  EXPECT_EQ(chip_->lights().back(), device::Light::kDark);
  EXPECT_EQ(switch_->status().limited, 2);
  post_and_wait(device::Light::kVertical);
  EXPECT_EQ(chip_->lights().back(), device::Light::kVertical);
  // A restart gives no new credit.
  switch_->stop();
  ASSERT_TRUE(switch_->start());
  post_and_wait(device::Light::kFlash);
  EXPECT_EQ(chip_->lights().back(), device::Light::kDark);
}

TEST_F(GpioLightSwitchTest, AnAbsurdSequenceKeepsTheDuty) {
  ASSERT_TRUE(switch_->start());
  const device::Clock clock = device::machine_clock();
  const double begin_s = clock.now_s();
  std::vector<device::LightSwitching> done;
  while (clock.now_s() < begin_s + 1.5) {
    // Nearly always on.
    switch_->post({device::Light::kFlash, 0.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    switch_->post({device::Light::kDark, 0.0});
    for (const device::LightSwitching& each : switch_->take_done()) done.push_back(each);
  }
  double lit_s = 0.0;
  for (std::size_t i = 0; i + 1 < done.size(); ++i)
    if (done[i].light == device::Light::kFlash) lit_s += done[i + 1].after_s - done[i].before_s;
  const double window_s = done.back().after_s - done.front().before_s;
  // The documented bound; the thread may wake up late by 20 ms.
  EXPECT_LE(lit_s, 0.5 * window_s + 0.5 * 0.1 + 0.02);
  EXPECT_GT(lit_s, 0.2 * window_s);
}

TEST_F(GpioLightSwitchTest, IsDarkBeforeASuspendAndLightsNothingUntilTheComputerIsAwake) {
  testing::FakeLogind logind;
  if (!logind.is_running()) GTEST_SKIP() << "dbus-daemon is not installed";
  ASSERT_TRUE(switch_->start());
  wait_until([&](const device::LightSwitchStatus&) { return logind.is_delayed(); });
  post_and_wait(device::Light::kVertical);
  logind.announce(true);
  wait_until([&](const device::LightSwitchStatus&) { return !logind.is_delayed(); });
  EXPECT_THAT(chip_->lights(), ElementsAre(device::Light::kVertical, device::Light::kDark));
  post_and_wait(device::Light::kHorizontal);
  EXPECT_EQ(chip_->lights().back(), device::Light::kDark);
  logind.announce(false);
  wait_until([&](const device::LightSwitchStatus&) { return logind.is_delayed(); });
  post_and_wait(device::Light::kHorizontal);
  EXPECT_EQ(chip_->lights().back(), device::Light::kHorizontal);
}

TEST_F(GpioLightSwitchTest, ReportsAFailedStart) {
  chip_->plugged = false;
  const auto started = switch_->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(switch_->status().state, device::LightSwitchState::kFailed);
  EXPECT_EQ(switch_->status().message, "no chip: plug it in");
  EXPECT_EQ(switch_->post({device::Light::kVertical, 0.0}), 0);
}

TEST(LightWiring, ReportsInvalidSettings) {
  LightWiring wiring{{"ftdi-cbus", "", ""}, {"", 0}, {"", 1}, std::nullopt, {}};
  EXPECT_TRUE(wiring.validate());
  wiring.flash = LineMatch{"", 1};
  EXPECT_THAT(wiring.validate().error().message, HasSubstr("same"));
  wiring.flash = LineMatch{};
  EXPECT_THAT(wiring.validate().error().message, HasSubstr("flash"));
  wiring.flash.reset();
  wiring.chip = {};
  EXPECT_THAT(wiring.validate().error().message, HasSubstr("chip"));
}

}  // namespace
}  // namespace flytri::gpio
