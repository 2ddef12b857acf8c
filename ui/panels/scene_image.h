/// @file  Shows the picture of the scene in a frame of Dear ImGui. It is copied: without a graphics
/// card, a textured rectangle takes several times as long.
#pragma once

#include "ui/gpu/texture.h"
#include "ui/widgets/rect.h"

namespace flytri::ui {

/// Must not be moved in memory until the frame is drawn.
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
