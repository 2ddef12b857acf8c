/// @file  Shows parts of a window. Without a graphics card, a swap would send the whole picture to
/// the screen.
#pragma once

#include <optional>

#include "ui/gpu/pixel_box.h"

namespace flytri::ui {

class PartialSwap {
 public:
  /// For the window whose context is current.
  /// @return  nothing if a graphics card draws, which swaps at no cost, or if the window system can
  ///          only swap
  [[nodiscard]] static std::optional<PartialSwap> find();
  /// Sends a part of the framebuffer to the screen; the rest stays.
  void show(const PixelBox& part) const;

 private:
  PartialSwap(void* display, unsigned long drawable) : display_(display), drawable_(drawable) {}
  void* display_;
  unsigned long drawable_;
};

}  // namespace flytri::ui
