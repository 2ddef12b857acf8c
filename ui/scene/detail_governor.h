/// @file  Decides how many surfels a picture can afford, from what the last ones took.
#pragma once

#include <cstddef>

namespace flytri::ui {

class DetailGovernor {
 public:
  /// What a picture of `surfels` took.
  void learn(std::size_t surfels, double ms);
  /// How many of `visible` surfels a picture may draw within `aim_ms`: 0 < share <= 1. It stays as
  /// it is while the time is near the aim, as a model that changes its grain flickers.
  [[nodiscard]] double share_for(std::size_t visible, double aim_ms);
  /// How many surfels can be drawn within `aim_ms`.
  [[nodiscard]] std::size_t affordable(double aim_ms) const;

 private:
  double ms_per_surfel_ = 0.0;  ///< 0: not known yet
  double share_ = 1.0;
};

}  // namespace flytri::ui
