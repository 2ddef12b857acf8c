/// @file  A histogram of the brightness of pixels.
#pragma once

#include <span>

#include "ui/widgets/draw.h"

namespace flytri::ui {

/// @param shares  of all pixels, by rising brightness; the last bin holds clipped pixels
void histogram(const Theme& theme, const Rect& box, std::span<const double> shares);

}  // namespace flytri::ui
