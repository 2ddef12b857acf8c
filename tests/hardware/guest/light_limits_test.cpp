// Measures at the pins of the emulated chips how long lights are on when a program misbehaves, and
// prints a table.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "hw/device/clock.h"
#include "hw/gpio/gpio_light_switch.h"
#include "tests/hardware/guest/usb_bench.h"

namespace flytri {
namespace {

using testing::lit_pins;
using testing::PinEdge;
using testing::wait_until;

constexpr device::LightLimit kLimit = {0.5, 0.25};
// Time in which a program misbehaves: several times on and rest.
constexpr double kRun_s = 8.0;

gpio::LightWiring limited_wiring(const char* label) {
  return {{label, "", ""}, {"", 0}, {"", 1}, gpio::LineMatch{"", 2}, {kLimit, kLimit, kLimit}};
}

/// How one pin was lit.
struct OnTimes {
  double longest_s = 0.0;
  double share = 0.0;  // of the whole run
  bool keeps_duty = true;
};

struct Stretch {
  double begin_s = 0.0;
  double end_s = 0.0;
};

std::vector<Stretch> stretches_of(const std::vector<PinEdge>& edges, unsigned pin, double end_s) {
  std::vector<Stretch> stretches;
  bool is_on = false;
  for (const PinEdge& edge : edges) {
    const bool is_lit = (edge.pins & pin) != 0;
    if (is_lit && !is_on) stretches.push_back({edge.time_s, end_s});
    if (!is_lit && is_on) stretches.back().end_s = edge.time_s;
    is_on = is_lit;
  }
  return stretches;
}

/// Checks the documented bound from the start of each stretch to the end of each later one.
OnTimes on_times(const std::vector<Stretch>& stretches, double run_s) {
  OnTimes times;
  double all_s = 0.0;
  for (std::size_t first = 0; first < stretches.size(); ++first) {
    const double lit_s = stretches[first].end_s - stretches[first].begin_s;
    times.longest_s = std::max(times.longest_s, lit_s);
    all_s += lit_s;
    double sum_s = 0.0;
    for (std::size_t last = first; last < stretches.size(); ++last) {
      sum_s += stretches[last].end_s - stretches[last].begin_s;
      const double window_s = stretches[last].end_s - stretches[first].begin_s;
      times.keeps_duty &=
          sum_s <= kLimit.max_duty * window_s + (1.0 - kLimit.max_duty) * kLimit.max_on_s;
    }
  }
  times.share = all_s / run_s;
  return times;
}

/// What a program does wrong; it ends when the test kills it.
struct Misbehavior {
  const char* name;
  std::function<void(device::LightSwitch&)> act;
};

void post(device::LightSwitch& lights, device::Light light, double from_now_s = 0.0) {
  lights.post({light, device::machine_clock().now_s() + from_now_s});
}

const std::vector<Misbehavior> kMisbehaviors = {
    {"reader stopped",
     [](device::LightSwitch& lights) {
       // What a sensor posts ahead, then nothing.
       for (int i = 0; i < 6; ++i)
         post(lights, i % 2 == 0 ? device::Light::kVertical : device::Light::kHorizontal,
              0.033 * i);
       pause();
     }},
    {"dialog idle",
     [](device::LightSwitch& lights) {
       post(lights, device::Light::kFlash);
       pause();
     }},
    {"flash period absurd",
     [](device::LightSwitch& lights) {
       for (;;) {
         post(lights, device::Light::kFlash);
         usleep(98'000);
         post(lights, device::Light::kVertical);
         usleep(2'000);
       }
     }},
    {"process stopped",
     [](device::LightSwitch& lights) {
       post(lights, device::Light::kFlash);
       usleep(100'000);
       raise(SIGSTOP);
       pause();
     }},
    {"process killed", [](device::LightSwitch& lights) {
       post(lights, device::Light::kFlash);
       usleep(100'000);
       raise(SIGKILL);
     }}};

pid_t start_program(const char* label, const Misbehavior& misbehavior) {
  const pid_t program = fork();
  if (program != 0) return program;
  auto lights = gpio::GpioLightSwitch::create(limited_wiring(label));
  if (!lights || !(*lights)->start()) std::_Exit(1);
  misbehavior.act(**lights);
  std::_Exit(0);
}

OnTimes worst(const std::vector<PinEdge>& edges, double end_s) {
  OnTimes all;
  for (const unsigned pin : {1U, 2U, 4U}) {
    const OnTimes times = on_times(stretches_of(edges, pin, end_s), kRun_s);
    all.longest_s = std::max(all.longest_s, times.longest_s);
    all.share = std::max(all.share, times.share);
    all.keeps_duty &= times.keeps_duty;
  }
  return all;
}

TEST(LightLimitsAtThePins, AreKeptWhateverTheProgramDoes) {
  testing::restore_all();
  std::printf(
      "| chip | program | longest on, s | limit | share of time | duty kept | dark at end |\n"
      "|---|---|---|---|---|---|---|\n");
  const device::Clock clock = device::machine_clock();
  for (const char* label : {"ftdi-cbus", "mcp2221_gpio"}) {
    for (const Misbehavior& misbehavior : kMisbehaviors) {
      const double begin_s = clock.now_s();
      const pid_t program = start_program(label, misbehavior);
      ASSERT_GT(program, 0);
      clock.sleep_s(kRun_s);
      const bool is_dark = lit_pins() == 0;
      const OnTimes times = worst(testing::pin_edges(begin_s), clock.now_s());
      std::printf("| %s | %s | %.3f | %.3f | %.3f | %s | %s |\n", label, misbehavior.name,
                  times.longest_s, kLimit.max_on_s, times.share, times.keeps_duty ? "yes" : "NO",
                  is_dark ? "yes" : "no");
      EXPECT_GT(times.longest_s, 0.05) << misbehavior.name << ": no light was on";
      EXPECT_LE(times.longest_s, kLimit.max_on_s) << misbehavior.name;
      EXPECT_TRUE(times.keeps_duty) << misbehavior.name;
      // A stopped process dies by SIGKILL, too.
      kill(program, SIGKILL);
      waitpid(program, nullptr, 0);
      wait_until([] { return lit_pins() == 0; });
    }
  }
}

}  // namespace
}  // namespace flytri
