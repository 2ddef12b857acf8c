/// @file  Keeps a small picture of what the sensor saw at places all over a scan.
#pragma once

#include <memory>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

/// Bounded by the surface, not by time: where a picture was taken already, none is kept.
class ReentryImages {
 public:
  /// @param apart_mm  > 0, distance of poses from which a picture shows another place
  /// @param arm_mm  > 0, radius of what the sensor sees: weighs rotation against translation
  ReentryImages(double apart_mm, double arm_mm) : apart_mm_(apart_mm), arm_mm_(arm_mm) {}

  void add(const Frame& frame, const Isometry& T_world_sensor);
  /// The picture nearest to a pose; null: none is near.
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
