#include "hw/gpio/suspend_watch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>

#include "hw/device/clock.h"
#include "tests/support/fake_logind.h"

namespace flytri::gpio {
namespace {

void wait_for(const std::function<bool()>& reached) {
  const device::Clock clock = device::machine_clock();
  const double end_s = clock.now_s() + 60.0;
  while (!reached()) {
    ASSERT_LT(clock.now_s(), end_s);
    clock.sleep_s(0.002);
  }
}

TEST(SuspendWatch, DelaysASuspendUntilTheLightsAreDark) {
  testing::FakeLogind logind;
  if (!logind.is_running()) GTEST_SKIP() << "dbus-daemon is not installed";
  std::atomic<int> told{-1};
  std::atomic<bool> is_dark{false};
  const SuspendWatch watch([&](bool suspends) {
    told = suspends ? 1 : 0;
    if (suspends) wait_for([&] { return is_dark.load(); });
  });
  wait_for([&] { return logind.is_delayed(); });
  logind.announce(true);
  wait_for([&] { return told == 1; });
  EXPECT_TRUE(logind.is_delayed()) << "the lights are not dark yet";
  is_dark = true;
  wait_for([&] { return !logind.is_delayed(); });
  logind.announce(false);
  wait_for([&] { return told == 0 && logind.is_delayed(); });
  EXPECT_EQ(logind.lent(), 2) << "the next suspend is delayed, too";
}

TEST(SuspendWatch, EndsAtOnceWhereThereIsNoLogind) {
  setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/nowhere", 1);
  const device::Clock clock = device::machine_clock();
  const double begin_s = clock.now_s();
  {
    const SuspendWatch watch([](bool) {});
  }
  EXPECT_LT(clock.now_s() - begin_s, 4.0);
  unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
}

}  // namespace
}  // namespace flytri::gpio
