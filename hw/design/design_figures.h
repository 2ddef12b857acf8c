/// @file  What a sensor of this layout can do: resolution, uncertainty and depth of focus. Can its
/// lines be told apart?
///
/// @source  Arold et al., sections as named at each figure. The simulated sensor judges them, see
///          tests/unit/hw/design.
#pragma once

#include <array>
#include <optional>

#include "hw/design/line_image.h"
#include "hw/design/unique_areas.h"
#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::design {

/// The middle of white light.
inline constexpr double kWavelength_mm = 0.55e-3;

/// Figures at one depth; vertical lines.
struct DepthFigures {
  LineFigures line;
  /// "Line Localization": what the three-point interpolation of the paper reaches, a seventh of a
  /// pixel.
  double three_point_mm = 0.0;
  /// "Physical Optimization": C / (2 pi) * wavelength / (sin u * sin theta), the limit by speckle.
  double speckle_limit_mm = 0.0;
  /// "Physical Optimization": the least distance of two grooves along the lines: 2 line widths on
  /// the object; and of two grooves across them: 2 widths of the camera's blur, at least 2 pixels.
  double grooves_along_lines_mm = 0.0, grooves_across_lines_mm = 0.0;
};

/// "Physical Optimization": the depths at which the line in the image is at most sqrt(2) times as
/// wide as at its narrowest.
struct FocusRange {
  double least_mm = 0.0, most_mm = 0.0;  ///< z in the sensor frame
  double narrowest_px = 0.0;
};

struct PatternFigures {
  int lines = 0;
  UniqueAreas areas;
  double largest_depth_mm = 0.0;
  int most_lines = 0;
};

struct DesignFigures {
  std::array<DepthFigures, 3> depths;  ///< near end, middle and far end of the volume
  FocusRange focus;
  std::array<PatternFigures, 2> patterns;  ///< by Pattern
  /// Share of the volume's cross-section that the camera sees at the near end.
  double seen_share = 0.0;
  /// Standard deviation of the blur that the aperture of the camera causes by diffraction alone.
  double diffraction_px = 0.0;
};

/// @errors  As SensorModel::validate.
[[nodiscard]] Result<DesignFigures> design_figures(const simulated::SensorLayout& layout);

}  // namespace flytri::design
