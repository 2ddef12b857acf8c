/// @file  A sheet to print: the smallest paper that holds its content, with words and rulers by
/// which the print is checked.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "hw/drawing/drawing.h"

namespace flytri::sheets {

/// Length of both rulers: long enough that calipers tell a thousandth.
inline constexpr double kRuler_mm = 100.0;

struct Sheet {
  drawing::Drawing drawing;
  std::string paper;               ///< "A4"
  Vec2 middle_mm = Vec2::Zero();   ///< of the place for the content, on the page
  Vec2 x_ruler_mm = Vec2::Zero();  ///< its left end
  Vec2 y_ruler_mm = Vec2::Zero();  ///< its upper end
};

/// A page of ISO 216 in landscape with title, notes and two rulers, and room for the content.
/// @errors  kBadOption: the content is too large for A0.
[[nodiscard]] Result<Sheet> start_sheet(const std::string& title,
                                        const std::vector<std::string>& notes,
                                        const Vec2& content_mm);

}  // namespace flytri::sheets
