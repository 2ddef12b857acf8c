/// @file  Everything drawn over the model, as thick lines.
#pragma once

#include <cstdint>
#include <vector>

#include "ui/scene/eye.h"
#include "ui/scene/scene_content.h"
#include "ui/scene/scene_options.h"

namespace flytri::ui {

struct OverlayLine {
  Vec3f from_mm;
  Vec3f to_mm;
  float width_px = 2.0F;
  Color color;
  bool shows_through = true;  ///< drawn faintly where the model is in front
  bool operator==(const OverlayLine&) const = default;
};

/// Profiles, sensors, rims of the holes that face the eye, measured segments, the occlusal plane,
/// lines on the surface and the brush.
/// @param now_s  drives what pulses
[[nodiscard]] std::vector<OverlayLine> overlay_lines(const SceneContent& content,
                                                     const SceneOptions& options, const Eye& eye,
                                                     double now_s);

/// Box around the lines that may lie outside of the model.
[[nodiscard]] Eigen::AlignedBox3d overlay_box_mm(const SceneContent& content);

}  // namespace flytri::ui
