/// @file  A bar that shows whether the sensor is too near, good, or too far.
#pragma once

#include <optional>

#include "core/scan/scan_snapshot.h"
#include "ui/text/texts.h"
#include "ui/widgets/draw.h"

namespace flytri::ui {

enum class DistanceVerdict { kTooNear, kFine, kTooFar };

/// Share of half the volume's depth. Beyond it, much of the surface is about to leave the volume.
inline constexpr double kGoodDepthShare = 0.5;

[[nodiscard]] DistanceVerdict judge_distance(double depth_share);

/// Three zones with a marker, and the result in words. Without a distance, an empty bar.
void distance_bar(const Theme& theme, const Rect& box,
                  const std::optional<scan::SensorDistance>& distance, const Texts& texts);

}  // namespace flytri::ui
