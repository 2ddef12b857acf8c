/// @file  What the image beside a localized sample says about the shape of its line.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>

#include "core/imaging/pattern.h"
#include "core/localization/line_trace.h"

namespace flytri::lab {

/// By which a translucent or glossy surface may be told from a matte one.
enum class ShapeProperty {
  kWidth,      ///< full width at half maximum, in widths of the calibrated line
  kAsymmetry,  ///< light away from the projector minus that on its side, over both
  kHalo,       ///< level 1.5 to 2.5 widths beside the line above that 5 to 6 widths beside it, in
               ///< heights of the line
  kHeight,     ///< of the line, gray values; negative, so that a larger value is a darker line
};
inline constexpr std::array kShapeProperties = {ShapeProperty::kWidth, ShapeProperty::kAsymmetry,
                                                ShapeProperty::kHalo, ShapeProperty::kHeight};
[[nodiscard]] std::string_view to_string(ShapeProperty property);

/// By ShapeProperty.
using LineShape = std::array<double, kShapeProperties.size()>;

struct ShapeReference {
  double width_px = 1.0;  ///< > 0, of the line as calibrated at this place
  int away = 1;           ///< 1 if the light comes from the side of smaller positions, else -1
};

/// @param image  CV_8UC1
/// @return  none where the line is less than 6 widths from the image's border
[[nodiscard]] std::optional<LineShape> line_shape(const cv::Mat& image, Pattern pattern,
                                                  const localization::LineSample& sample,
                                                  const ShapeReference& reference);

}  // namespace flytri::lab
