/// @file  The scene's picture in a frame of Dear ImGui: copied, as a textured rectangle costs a
/// processor that draws several times as much.
#pragma once

#include "ui/gpu/texture.h"
#include "ui/widgets/rect.h"

namespace flytri::ui {

/// Must stay where it is until the frame is drawn.
class SceneImage {
 public:
  /// @param picture  must live until the frame is drawn
  /// @param place    whole pixels, as large as the picture
  void add(const Framebuffer& picture, const Rect& place);

 private:
  void copy(const ImVec4& clip) const;

  const Framebuffer* picture_ = nullptr;
  Rect place_;
  float window_height_px_ = 0.0F;
};

}  // namespace flytri::ui
