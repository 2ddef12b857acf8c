/// @file  Measures how long drawing takes.
#pragma once

#include <epoxy/gl.h>

#include <chrono>

namespace flytri::ui {

/// Measures from construction to stop(), which waits until everything is drawn. Timer queries are
/// not used, as software renderers report less than half of the time.
class FrameTimer {
 public:
  [[nodiscard]] double stop_ms() const {
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began_)
        .count();
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace flytri::ui
