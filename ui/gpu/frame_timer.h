/// @file  How long the graphics take, without waiting for them.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

#include "ui/gpu/gl_object.h"

namespace flytri::ui {

void delete_query(GLuint name);

/// A measured piece of drawing.
struct TimedWork {
  std::size_t amount = 0;  ///< as the caller said at end()
  double ms = 0.0;
};

/// Adds what the processor spends on handing over to what the graphics spend on drawing: a software
/// renderer does the one in the calling thread and the other in its own.
class FrameTimer {
 public:
  FrameTimer();
  void begin();
  void end(std::size_t amount);
  /// The next finished piece, oldest first; empty where the graphics are still at it.
  [[nodiscard]] std::optional<TimedWork> take();

 private:
  struct Piece {
    GlObject<delete_query> query;
    std::size_t amount = 0;
    double handed_over_ms = 0.0;
  };
  std::array<Piece, 4> pieces_;  ///< a ring
  std::size_t next_ = 0;         ///< to begin
  std::size_t waiting_ = 0;      ///< ended, not taken
  bool is_open_ = false;
  std::chrono::steady_clock::time_point began_;
};

}  // namespace flytri::ui
