/// @file  How long a piece of drawing takes.
#pragma once

#include <epoxy/gl.h>

#include <chrono>

namespace flytri::ui {

/// From its making to stop(), which waits until all is drawn. A software renderer draws while it
/// is waited for, and says of its timer queries less than half of that; a graphics card is done
/// with one scene long before the next picture is due.
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
