/// @file  Decides how many surfels to draw, from the time that the last pictures took.
#pragma once

#include <cstddef>

namespace flytri::ui {

class DetailGovernor {
 public:
  /// Records that a picture of `surfels` took `ms`.
  void learn(std::size_t surfels, double ms);
  /// The share of `visible` surfels that can be drawn within `aim_ms`: 0 < share <= 1. Small
  /// differences in time do not change it, as a model of changing detail flickers.
  [[nodiscard]] double share_for(std::size_t visible, double aim_ms);
  /// How many surfels can be drawn within `aim_ms`.
  [[nodiscard]] std::size_t affordable(double aim_ms) const;

 private:
  double ms_per_surfel_ = 0.0;  ///< 0: not known yet
  double share_ = 1.0;
};

}  // namespace flytri::ui
