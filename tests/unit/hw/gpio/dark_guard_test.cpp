#include "hw/gpio/dark_guard.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace flytri::gpio {
namespace {

// Uses a file in place of the chip and detects when it is opened. The file is no GPIO chip, so an
// active guard retries for half a minute and then ends.
class DarkGuardTest : public ::testing::Test {
 protected:
  DarkGuardTest() {
    std::ofstream(chip_) << "no chip";
    EXPECT_GE(inotify_add_watch(opened_, chip_.c_str(), IN_OPEN), 0);
  }
  ~DarkGuardTest() override { close(opened_); }

  [[nodiscard]] DarkRequest order() const {
    return {-1, chip_.string(), "label", {0, 1}, {0, 1}, {{0.2, 0.5}, {0.2, 0.5}, {0.2, 0.5}}};
  }
  // Whether the chip is opened within the time.
  [[nodiscard]] bool is_opened(int timeout_ms) const {
    pollfd waiting{opened_, POLLIN, 0};
    return poll(&waiting, 1, timeout_ms) == 1;
  }

  TemporaryFolder folder_;
  std::filesystem::path chip_ = folder_ / "chip";
  int opened_ = inotify_init1(IN_CLOEXEC);
};

TEST_F(DarkGuardTest, OpensTheChipWhenTheProgramIsKilled) {
  std::array<int, 2> lives{};
  ASSERT_EQ(pipe(lives.data()), 0);
  const pid_t program = fork();
  if (program == 0) {
    close(lives[1]);
    const auto guard = DarkGuard::start(order());
    char word = 0;
    // Killed while it waits, so the guard is not dismissed.
    _exit(guard ? static_cast<int>(read(lives[0], &word, 1)) : 1);
  }
  close(lives[0]);
  EXPECT_FALSE(is_opened(100));
  kill(program, SIGKILL);
  waitpid(program, nullptr, 0);
  EXPECT_TRUE(is_opened(60'000));
  close(lives[1]);
}

TEST_F(DarkGuardTest, ADismissedGuardDoesNotOpenTheChip) {
  { const auto guard = DarkGuard::start(order()).value(); }
  // The guard process has ended; the destructor waited for it.
  EXPECT_FALSE(is_opened(0));
}

TEST_F(DarkGuardTest, OpensTheChipWhenALightIsOnForTooLong) {
  const auto guard = DarkGuard::start(order()).value();
  ASSERT_EQ(guard->begin(device::Light::kVertical), 0);
  ASSERT_EQ(guard->finish(device::Light::kVertical), 0);
  EXPECT_FALSE(is_opened(100));
  // The program hangs: it announces nothing more.
  EXPECT_TRUE(is_opened(60'000));
}

TEST_F(DarkGuardTest, DoesNothingWhileTheProgramKeepsTheLimits) {
  const auto guard = DarkGuard::start(order()).value();
  const timespec on{0, 5'000'000};
  const timespec off{0, 10'000'000};
  for (int i = 0; i < 40; ++i) {
    ASSERT_EQ(guard->begin(device::Light::kVertical), 0);
    ASSERT_EQ(guard->finish(device::Light::kVertical), 0);
    nanosleep(&on, nullptr);
    ASSERT_EQ(guard->finish(device::Light::kDark), 0);
    nanosleep(&off, nullptr);
  }
  EXPECT_FALSE(is_opened(0));
}

TEST_F(DarkGuardTest, ReportsThatItWasKilled) {
  const auto guard = DarkGuard::start(order()).value();
  const std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
  std::stringstream list;
  list << children.rdbuf();
  pid_t child = 0;
  ASSERT_TRUE(list >> child);
  kill(child, SIGKILL);
  siginfo_t ended{};
  waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);
  EXPECT_NE(guard->begin(device::Light::kVertical), 0);
}

TEST_F(DarkGuardTest, KeepsNoFileOfTheProgramOpen) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const auto guard = DarkGuard::start(order()).value();
  close(ends[1]);
  pollfd waiting{ends[0], POLLIN, 0};
  ASSERT_EQ(poll(&waiting, 1, 60'000), 1);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0) << "the guard keeps the other end of the pipe open";
  close(ends[0]);
}

TEST_F(DarkGuardTest, AProgramWithLightsIgnoresCtrlZ) {
  const auto stop_action = [] {
    struct sigaction action {};
    sigaction(SIGTSTP, nullptr, &action);
    return action.sa_handler;
  };
  ASSERT_EQ(stop_action(), SIG_DFL);
  {
    const auto guard = DarkGuard::start(order()).value();
    EXPECT_EQ(stop_action(), SIG_IGN);
  }
  EXPECT_EQ(stop_action(), SIG_DFL);
}

TEST_F(DarkGuardTest, KeepsTheProgramsOwnHandlerOfCtrlZ) {
  std::signal(SIGTSTP, [](int) {});
  { const auto guard = DarkGuard::start(order()).value(); }
  EXPECT_NE(std::signal(SIGTSTP, SIG_DFL), SIG_DFL);
}

}  // namespace
}  // namespace flytri::gpio
