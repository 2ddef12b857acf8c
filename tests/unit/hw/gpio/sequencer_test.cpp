#include "hw/gpio/sequencer.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <functional>
#include <thread>

#include "hw/device/clock.h"
#include "hw/gpio/gpio_light_switch.h"
#include "hw/gpio/sequencer_lines.h"
#include "tests/support/sequencer_board.h"

namespace flytri::gpio {
namespace {

using ::testing::HasSubstr;
using testing::SequencerBoard;

constexpr int kTexture = 1;  // trigger

bool wait_until(const std::function<bool()>& holds) {
  const device::Clock clock = device::machine_clock();
  for (const double end_s = clock.now_s() + 20.0; clock.now_s() < end_s;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

const std::vector<device::LightLimit> kLimits(kSequencerOutputs);

TEST(Sequencer, TurnsOneLightOnAndTheOthersOff) {
  const SequencerBoard board;
  {
    const auto sequencer = Sequencer::open(board.node(), kLimits);
    ASSERT_TRUE(sequencer) << sequencer.error().message;
    EXPECT_EQ((*sequencer)->shine(0), 0);
    EXPECT_TRUE(board.is_high(0));
    EXPECT_EQ((*sequencer)->shine(2), 0);
    EXPECT_FALSE(board.is_high(0));
    EXPECT_TRUE(board.is_high(2));
    EXPECT_EQ((*sequencer)->shine(std::nullopt), 0);
    EXPECT_TRUE(board.is_dark());
    EXPECT_EQ((*sequencer)->shine(1), 0);
    EXPECT_TRUE((*sequencer)->is_well());
  }
  EXPECT_TRUE(board.is_dark()) << "after the program ended well";
}

/// A light that stays on outlives the silence as long as the program lives.
TEST(Sequencer, StaysLitWhileTheProgramIsThere) {
  const SequencerBoard board;
  const auto sequencer = Sequencer::open(board.node(), kLimits);
  ASSERT_TRUE(sequencer);
  ASSERT_EQ((*sequencer)->shine(1), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  EXPECT_TRUE(board.is_high(1));
  EXPECT_TRUE((*sequencer)->is_well());
}

/// As after kill -9, SIGSTOP or a broken cable: nobody says anything any more.
TEST(Sequencer, IsDarkAfterATenthOfASecondOfSilence) {
  const SequencerBoard board;
  const int port = open(board.node().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_GE(port, 0);
  ASSERT_EQ(write(port, "L 0\n", 4), 4);
  ASSERT_TRUE(wait_until([&] { return board.is_high(0); }));
  ASSERT_TRUE(wait_until([&] { return board.is_dark(); }));
  close(port);
  const auto changes = board.changes();
  ASSERT_EQ(changes.size(), 2U);
  const double lit_s = changes[1].time_s - changes[0].time_s;
  EXPECT_GT(lit_s, 0.099);
  EXPECT_LT(lit_s, 0.2) << "a busy machine runs the program of the board late";
}

TEST(Sequencer, KeepsTheLimitsOfEachLight) {
  const SequencerBoard board;
  std::vector<device::LightLimit> limits = kLimits;
  limits[2] = {0.15, 0.25};
  const auto sequencer = Sequencer::open(board.node(), limits);
  ASSERT_TRUE(sequencer);
  ASSERT_EQ((*sequencer)->shine(2), 0);
  ASSERT_TRUE(wait_until([&] { return board.is_dark(); }));
  const auto changes = board.changes();
  EXPECT_LT(changes.back().time_s - changes.front().time_s, 0.25);
  EXPECT_TRUE(wait_until([&] { return !(*sequencer)->is_well(); }));
  EXPECT_EQ((*sequencer)->shine(2), EPERM) << "it rests";
  EXPECT_EQ((*sequencer)->shine(0), 0);
  EXPECT_FALSE((*sequencer)->expose(2, kTexture, 0.01));
}

TEST(Sequencer, ExposesWithinItsLightAndIsDarkAfterwards) {
  const SequencerBoard board;
  const auto sequencer = Sequencer::open(board.node(), kLimits);
  ASSERT_TRUE(sequencer);
  const auto first = (*sequencer)->expose(1, 0, 0.008);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(first->number, 1);
  const auto early = (*sequencer)->expose(0, 0, 0.008);
  ASSERT_FALSE(early);
  EXPECT_THAT(early.error().message, HasSubstr("exposing"));
  ASSERT_TRUE(wait_until([&] { return board.is_dark(); }));
  const auto second = (*sequencer)->expose(2, kTexture, 0.02);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->number, 2);
  ASSERT_TRUE(wait_until([&] { return board.is_dark(); }));

  const auto changes = board.changes();
  ASSERT_EQ(changes.size(), 8U);
  const int lights[] = {1, 2};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto* of = &changes[4 * k];
    const int trigger = SequencerBoard::kFirstTrigger + static_cast<int>(k);
    EXPECT_EQ(of[0].pin, lights[k]);
    EXPECT_EQ(of[1].pin, trigger) << "light before the exposure";
    EXPECT_EQ(of[2].pin, trigger) << "exposure before the dark";
    EXPECT_EQ(of[3].pin, lights[k]);
    EXPECT_GE(of[2].time_s - of[1].time_s, k == 0 ? 0.0079 : 0.0199);
  }
  EXPECT_NEAR(second->board_s - first->board_s, changes[5].time_s - changes[1].time_s, 0.005);
}

TEST(Sequencer, CountsExposuresFromOneForEachProgram) {
  const SequencerBoard board;
  for (int program = 0; program < 2; ++program) {
    const auto sequencer = Sequencer::open(board.node(), kLimits);
    ASSERT_TRUE(sequencer);
    const auto exposure = (*sequencer)->expose(0, 0, 0.001);
    ASSERT_TRUE(exposure);
    EXPECT_EQ(exposure->number, 1);
  }
}

TEST(Sequencer, SaysWhatIsWrongWithAPort) {
  const auto missing = Sequencer::open("/dev/ttyACM77", kLimits);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  SequencerBoard board;
  board.mute(true);
  const auto silent = Sequencer::open(board.node(), kLimits);
  ASSERT_FALSE(silent);
  EXPECT_THAT(silent.error().message, HasSubstr("does not answer as a sequencer"));
}

/// The program before ended in the middle of a command.
TEST(Sequencer, OpensAfterHalfACommand) {
  const SequencerBoard board;
  const int port = open(board.node().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_EQ(write(port, "M 0 20", 6), 6);
  const auto sequencer = Sequencer::open(board.node(), kLimits);
  EXPECT_TRUE(sequencer) << sequencer.error().message;
  close(port);
}

LightWiring wiring_of_outputs() {
  LightWiring wiring;
  wiring.chip.label = kSequencerName;
  wiring.vertical.offset = 0;
  wiring.horizontal.offset = 1;
  wiring.flash.emplace().offset = 2;
  return wiring;
}

TEST(SequencerLines, RefuseWhatASequencerDoesNotHave) {
  LightWiring wiring = wiring_of_outputs();
  wiring.horizontal.offset = 3;
  const auto far = open_sequencer_lines("/dev/null", wiring);
  ASSERT_FALSE(far);
  EXPECT_THAT(far.error().message, HasSubstr("outputs 0 to 2"));
  wiring.horizontal.offset = 1;
  wiring.horizontal.active_low = true;
  const auto low = open_sequencer_lines("/dev/null", wiring);
  ASSERT_FALSE(low);
  EXPECT_THAT(low.error().message, HasSubstr("high for light"));
}

class SwitchOnASequencer : public ::testing::Test {
 protected:
  SwitchOnASequencer() {
    GpioLightSwitchOptions options;
    options.search_period_s = 0.01;
    switch_ = *GpioLightSwitch::create(
        [this] { return open_sequencer_lines(board_.node(), wiring_of_outputs()); }, options);
  }
  bool reaches(device::LightSwitchState state) {
    return wait_until([&] { return switch_->status().state == state; });
  }
  SequencerBoard board_;
  std::unique_ptr<GpioLightSwitch> switch_;
};

TEST_F(SwitchOnASequencer, CarriesOutRequests) {
  ASSERT_TRUE(switch_->start());
  switch_->post({device::Light::kFlash, 0.0});
  EXPECT_TRUE(wait_until([&] { return board_.is_high(2); }));
  switch_->post({device::Light::kVertical, 0.0});
  EXPECT_TRUE(wait_until([&] { return board_.is_high(0) && !board_.is_high(2); }));
  switch_->stop();
  EXPECT_TRUE(board_.is_dark());
}

TEST_F(SwitchOnASequencer, ABoardThatHangsIsDarkLostAndFoundAgain) {
  ASSERT_TRUE(switch_->start());
  switch_->post({device::Light::kHorizontal, 0.0});
  ASSERT_TRUE(wait_until([&] { return board_.is_high(1); }));
  const double hangs_s = device::machine_clock().now_s();
  board_.mute(true);
  ASSERT_TRUE(wait_until([&] { return board_.is_dark(); }));
  EXPECT_LT(board_.changes().back().time_s - hangs_s, 0.2);
  switch_->post({device::Light::kVertical, 0.0});
  EXPECT_TRUE(reaches(device::LightSwitchState::kLost));
  board_.mute(false);
  EXPECT_TRUE(reaches(device::LightSwitchState::kRunning));
  EXPECT_TRUE(wait_until([&] { return board_.is_high(0); })) << "its latest request again";
}

TEST_F(SwitchOnASequencer, NoticesThatItIsUnplugged) {
  ASSERT_TRUE(switch_->start());
  board_.unplug();
  EXPECT_TRUE(reaches(device::LightSwitchState::kLost));
}

}  // namespace
}  // namespace flytri::gpio
