#include "ui/scene/scene_options.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/check_options.h"

namespace flytri::ui {

Result<void> SceneOptions::validate() const {
  return OptionCheck("SceneOptions")
      .in_range("texture_blend", texture_blend, 0.0, 1.0)
      .positive("max_sigma_mm", max_sigma_mm)
      .in_range("scale", scale, 0.5, 4.0)
      .in_range("moving_frame_ms", moving_frame_ms, 5.0, 1000.0)
      .result();
}

Color sigma_color(double share) {
  /// @source  Nunez, Anderton, Renslow, "Optimizing colormaps with consideration for color vision
  ///          deficiency" (cividis), PLOS ONE 2018; its ends and three places between.
  static constexpr std::array<Color, 5> kRamp = {{{0.00F, 0.14F, 0.31F, 1.0F},
                                                  {0.25F, 0.30F, 0.42F, 1.0F},
                                                  {0.49F, 0.49F, 0.47F, 1.0F},
                                                  {0.73F, 0.69F, 0.42F, 1.0F},
                                                  {1.00F, 0.92F, 0.27F, 1.0F}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kRamp.size() - 1);
  const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(at), kRamp.size() - 2);
  const float weight = static_cast<float>(at - static_cast<double>(below));
  Color color = kRamp[below];
  for (std::size_t c = 0; c < color.size(); ++c) {
    color[c] += weight * (kRamp[below + 1][c] - kRamp[below][c]);
  }
  return color;
}

}  // namespace flytri::ui
