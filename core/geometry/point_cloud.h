/// @file  Points on the measured surface, before and after data reduction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/index.h"
#include "core/geometry/rigid.h"
#include "core/imaging/pattern.h"

namespace flytri {

/// sRGB, 8 bits per channel.
using Rgb = std::array<std::uint8_t, 3>;

/// Color of a surface without texture: light plaster.
inline constexpr Rgb kUntexturedColor = {226, 222, 212};

/// One measured point with its normal, in the world frame, with the full noise of the sensor.
struct SurfaceSample {
  Vec3f position_mm;
  Vec3f normal;        ///< unit, outwards (towards the sensor)
  Vec3f deviation_mm;  ///< ProfilePoint::deviation_mm rotated into the world frame
  ViewIndex view;      ///< the view that measured it
  Pattern pattern = Pattern::kVertical;  ///< of that view
};

/// One point of the reduced surface, in the world frame.
struct SurfacePoint {
  Vec3f position_mm = Vec3f::Zero();
  Vec3f normal = Vec3f::UnitZ();  ///< unit, outwards
  Rgb color = kUntexturedColor;
  float sigma_mm = 0.0F;    ///< standard uncertainty along the normal; infinite: not measured
  PatternSet patterns = 0;  ///< those that measured the surface here; 0: not known
};

using PointCloud = std::vector<SurfacePoint>;

}  // namespace flytri
