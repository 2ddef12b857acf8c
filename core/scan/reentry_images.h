/// @file  Keeps small pictures of what the sensor saw, from places all over the scan.
#pragma once

#include <memory>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

/// One picture for each place: so memory grows with the surface, not with time.
class ReentryImages {
 public:
  /// @param apart_mm  > 0, poses farther apart than this see different places
  /// @param arm_mm  > 0, radius of what the sensor sees: weighs rotation against translation
  ReentryImages(double apart_mm, double arm_mm) : apart_mm_(apart_mm), arm_mm_(arm_mm) {}

  void add(const Frame& frame, const Isometry& T_world_sensor);
  /// The picture nearest to a pose. Null: none is near.
  [[nodiscard]] std::shared_ptr<const LiveFrame> nearest(const Isometry& T_world_sensor) const;

 private:
  struct Kept {
    std::shared_ptr<const LiveFrame> image;
    Isometry T_world_sensor;
  };
  double apart_mm_, arm_mm_;
  std::vector<Kept> kept_;
};

}  // namespace flytri::scan
