#include "ui/scene/scene_options.h"

#include <algorithm>
#include <array>
#include <span>

#include "core/base/check_options.h"

namespace flytri::ui {

Result<void> SceneOptions::validate() const {
  return OptionCheck("SceneOptions")
      .in_range("texture_blend", texture_blend, 0.0, 1.0)
      .positive("max_sigma_mm", max_sigma_mm)
      .positive("contact_mm", contact_mm)
      .in_range("scale", scale, 0.5, 4.0)
      .in_range("moving_frame_ms", moving_frame_ms, 5.0, 1000.0)
      .result();
}

namespace {

Color color_on(std::span<const Color> ramp, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
  const float weight = static_cast<float>(at - static_cast<double>(below));
  Color color = ramp[below];
  for (std::size_t c = 0; c < color.size(); ++c) {
    color[c] += weight * (ramp[below + 1][c] - ramp[below][c]);
  }
  return color;
}

}  // namespace

double max_sigma_mm(const Vec3& volume_mm) {
  // 30 µm of 20 mm, as the intra-oral sensor has it.
  constexpr double kShareOfWidth = 0.0015;
  return kShareOfWidth * volume_mm.x();
}

Color sigma_color(double share) {
  /// Blue over pale to orange: distinguishable with any color vision, and never dark, as the
  /// surface is shaded.
  static constexpr std::array<Color, 5> kRamp = {{{0.18F, 0.49F, 0.78F, 1.0F},
                                                  {0.48F, 0.75F, 0.88F, 1.0F},
                                                  {0.94F, 0.92F, 0.82F, 1.0F},
                                                  {0.95F, 0.68F, 0.30F, 1.0F},
                                                  {0.82F, 0.32F, 0.10F, 1.0F}}};
  return color_on(kRamp, share);
}

Color clearance_color(double share) {
  /// Yellow over pale to blue, as of sigma_color(): distinguishable with any color vision.
  static constexpr std::array<Color, 4> kRamp = {{{0.95F, 0.78F, 0.20F, 1.0F},
                                                  {0.94F, 0.92F, 0.72F, 1.0F},
                                                  {0.48F, 0.75F, 0.88F, 1.0F},
                                                  {0.18F, 0.49F, 0.78F, 1.0F}}};
  return color_on(kRamp, share);
}

Color undercut_color(double share) {
  /// Yellow over orange to dark red, on pale blue where it is free: distinguishable with any color
  /// vision.
  static constexpr std::array<Color, 3> kRamp = {
      {{0.98F, 0.86F, 0.32F, 1.0F}, {0.92F, 0.50F, 0.14F, 1.0F}, {0.62F, 0.08F, 0.12F, 1.0F}}};
  return color_on(kRamp, share);
}

}  // namespace flytri::ui
