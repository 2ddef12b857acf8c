#include "tests/support/sequencer_board.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "hw/device/clock.h"

// The program itself, as it is written to the board.
namespace flytri::testing::firmware {
// NOLINTNEXTLINE(bugprone-suspicious-include)
#include "hw/firmware/sequencer.c"

static SequencerBoard* board = nullptr;

void board_light(int light, bool high) { board->set_pin(light, high); }
void board_trigger(int output, bool high) {
  board->set_pin(SequencerBoard::kFirstTrigger + output, high);
}
void board_send(const char* text) { board->send(text); }
}  // namespace flytri::testing::firmware

namespace flytri::testing {
namespace {

std::uint32_t now_us() {
  return static_cast<std::uint32_t>(std::llround(1e6 * device::machine_clock().now_s()));
}

}  // namespace

SequencerBoard::SequencerBoard() {
  computer_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  grantpt(computer_);
  unlockpt(computer_);
  node_ = ptsname(computer_);
  firmware::board = this;
  firmware::sequencer_start(now_us());
  thread_ = std::thread([this] { run(); });
}

SequencerBoard::~SequencerBoard() {
  unplug();
  firmware::board = nullptr;
}

void SequencerBoard::unplug() {
  ends_ = true;
  if (thread_.joinable()) thread_.join();
  if (computer_ >= 0) ::close(std::exchange(computer_, -1));
}

void SequencerBoard::run() {
  while (!ends_) {
    char bytes[64];
    const ssize_t count = is_mute_ ? 0 : read(computer_, bytes, sizeof bytes);
    for (ssize_t i = 0; i < count; ++i) firmware::sequencer_byte(bytes[i], now_us());
    firmware::sequencer_tick(now_us());
    if (count <= 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

void SequencerBoard::set_pin(int pin, bool is_high) {
  const std::lock_guard lock(mutex_);
  if (pins_[pin] == is_high) return;
  pins_[pin] = is_high;
  changes_.push_back({device::machine_clock().now_s(), pin, is_high});
}

void SequencerBoard::send(const std::string& line) const {
  if (is_mute_) return;
  const std::string text = line + "\r\n";
  // A full line of a computer that does not read is lost, as on the wire.
  (void)!write(computer_, text.data(), text.size());
}

std::vector<SequencerBoard::PinChange> SequencerBoard::changes() const {
  const std::lock_guard lock(mutex_);
  return changes_;
}

bool SequencerBoard::is_high(int pin) const {
  const std::lock_guard lock(mutex_);
  return pins_[pin];
}

bool SequencerBoard::is_dark() const {
  const std::lock_guard lock(mutex_);
  return std::none_of(pins_, pins_ + kFirstTrigger, [](bool is_on) { return is_on; });
}

}  // namespace flytri::testing
