#include "ui/scene/scene_options.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flytri::ui {

Result<void> SceneOptions::validate() const {
  if (!(texture_blend >= 0.0 && texture_blend <= 1.0)) {
    return fail(ErrorCode::kBadOption, "texture_blend is {}; give 0 to 1", texture_blend);
  }
  if (!(max_sigma_mm > 0.0)) {
    return fail(ErrorCode::kBadOption, "max_sigma_mm is {}; give more than 0", max_sigma_mm);
  }
  if (!(scale >= 0.5 && scale <= 4.0)) {
    return fail(ErrorCode::kBadOption, "scale is {}; give 0.5 to 4", scale);
  }
  if (!(moving_frame_ms >= 5.0 && moving_frame_ms <= 1000.0)) {
    return fail(ErrorCode::kBadOption, "moving_frame_ms is {}; give 5 to 1000", moving_frame_ms);
  }
  return {};
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
