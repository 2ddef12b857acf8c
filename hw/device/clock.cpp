#include "hw/device/clock.h"

#include <chrono>
#include <thread>

namespace flytri::device {

Clock machine_clock() {
  return {
      [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
            .count();
      },
      [](double duration_s) {
        if (duration_s > 0.0)
          std::this_thread::sleep_for(std::chrono::duration<double>(duration_s));
      }};
}

}  // namespace flytri::device
