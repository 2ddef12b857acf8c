/// @file  How the scene is colored and how long a frame may take.
#pragma once

#include "core/base/result.h"
#include "core/geometry/rigid.h"
#include "ui/theme/status_colors.h"

namespace flytri::ui {

enum class ColorMode {
  kShading,      ///< like plaster: only the shape
  kTexture,      ///< the image of the texture camera over the plaster
  kCoverage,     ///< thin or good
  kUncertainty,  ///< standard uncertainty along the normal, from blue (low) to orange
  kClearance,    ///< of two jaws: distance to the other one
  kUndercut      ///< of the part that is looked at: how deep it is undercut
};

struct SceneOptions {
  ColorMode color_mode = ColorMode::kShading;
  double texture_blend = 1.0;  ///< 0..1, of kTexture: 0 is plaster, 1 the texture
  Color good_color = kNeutral;
  Color thin_color = kCaution;
  double max_sigma_mm = 0.03;  ///< > 0, end of the color scale of kUncertainty
  double contact_mm = 0.02;    ///< > 0, of kClearance: nearer than this is contact
  /// Moves the lower of two jaws from the place where they are closed.
  Isometry T_open_closed = Isometry::Identity();
  Color background_top = {0.16F, 0.18F, 0.21F, 1.0F};
  Color background_bottom = {0.06F, 0.07F, 0.08F, 1.0F};
  double scale = 1.0;             ///< 0.5..4, of the widths of overlays: content scale x user scale
  double moving_frame_ms = 25.0;  ///< 5..1000, time for the model while the camera moves: gives 30
                                  ///< pictures a second
  bool level_of_detail = true;    ///< false: every picture in full detail, however long it takes
  [[nodiscard]] Result<void> validate() const;
};

/// The colors of kUncertainty are logarithmic, from this part of max_sigma_mm to max_sigma_mm:
/// places are measured once to a few hundred times.
inline constexpr double kSigmaRange = 16.0;
/// max_sigma_mm for a sensor: about the noise of a single point. It grows with the volume.
[[nodiscard]] double max_sigma_mm(const Vec3& volume_mm);
/// Their scale from its low end, `share` 0, to its high end 1, for a legend.
[[nodiscard]] Color sigma_color(double share);

/// Farther than this, kClearance shows plaster.
inline constexpr double kFarClearance_mm = 1.0;
/// Where the jaws touch, and where one is inside the other by more than contact_mm.
inline constexpr Color kContactColor = {0.84F, 0.25F, 0.10F, 1.0F};
inline constexpr Color kPenetrationColor = {0.45F, 0.12F, 0.50F, 1.0F};
/// The scale of other clearances, from contact_mm at 0 to kFarClearance_mm at 1.
[[nodiscard]] Color clearance_color(double share);

/// Deeper than this, kUndercut has its last color.
inline constexpr double kDeepUndercut_mm = 0.5;
inline constexpr Color kFreeColor = {0.62F, 0.80F, 0.88F, 1.0F};
/// The scale of kUndercut, from just undercut at 0 to kDeepUndercut_mm at 1.
[[nodiscard]] Color undercut_color(double share);

}  // namespace flytri::ui
