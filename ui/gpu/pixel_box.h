/// @file  A rectangle of whole pixels.
#pragma once

#include <Eigen/Geometry>

namespace flytri::ui {

/// From the lower left corner of a picture, as OpenGL counts; min() and max() belong to it.
using PixelBox = Eigen::AlignedBox2i;

}  // namespace flytri::ui
