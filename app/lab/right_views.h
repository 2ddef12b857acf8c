/// @file  Counts the views of a scan that are where they belong.
#pragma once

#include <vector>

#include "core/geometry/view.h"

namespace flytri::lab {

/// A view is wrong if its points are further than this (RMS) from where most other views place
/// them. Several times the drift over a whole arch.
inline constexpr double kWrong_mm = 0.5;

/// The number of views that agree with the view that most agree with.
/// @param T_model_sensor  the true poses, parallel to `views`
[[nodiscard]] int count_right(const std::vector<AlignedView>& views,
                              const std::vector<Isometry>& T_model_sensor);

}  // namespace flytri::lab
