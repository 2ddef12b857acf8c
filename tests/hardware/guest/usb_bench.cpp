#include "tests/hardware/guest/usb_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "hw/device/clock.h"
#include "hw/device/device_node.h"

namespace flytri::testing {

namespace {

bool all_are_there() {
  const auto cameras = device::list_device_nodes("video4linux");
  const auto has_camera = [&](const char* serial) {
    return std::any_of(cameras.begin(), cameras.end(),
                       [&](const device::DeviceNode& camera) { return camera.serial == serial; });
  };
  return has_camera("M0001") && has_camera("C0002") &&
         device::list_device_nodes("gpio").size() == 2;
}

}  // namespace

void send_command(const std::string& line) { std::ofstream("/tmp/usb") << line << std::endl; }

unsigned lit_pins() {
  std::ifstream log("/tmp/lights");
  double time_s = 0.0;
  unsigned pins = 0;
  for (unsigned read = 0; log >> time_s >> read;) pins = read;
  return pins;
}

std::vector<PinEdge> pin_edges(double from_s) {
  std::ifstream log("/tmp/lights");
  std::vector<PinEdge> edges;
  for (PinEdge edge; log >> edge.time_s >> edge.pins;)
    if (edge.time_s >= from_s) edges.push_back(edge);
  return edges;
}

void wait_until(const std::function<bool()>& reached, double limit_s) {
  const device::Clock clock = device::machine_clock();
  const double end_s = clock.now_s() + limit_s;
  while (!reached()) {
    ASSERT_LT(clock.now_s(), end_s);
    clock.sleep_s(0.05);
  }
}

void restore_all() {
  for (const char* line :
       {"thaw camera", "unmute mcp", "plug camera", "plug camera2", "plug ftdi", "plug mcp"})
    send_command(line);
  wait_until(all_are_there, kPlugging_s);
}

}  // namespace flytri::testing
