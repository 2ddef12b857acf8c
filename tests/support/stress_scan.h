/// @file  Scans that go wrong in known ways, with their truth, and the verdict on a registration.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/tracking/registrar.h"
#include "hw/simulated/optics/sensor_path.h"
#include "hw/simulated/optics/view_simulator.h"

namespace flytri::testing {

/// Frames [begin, end).
struct FrameRange {
  int begin = 0, end = 0;
  [[nodiscard]] bool holds(int frame) const { return frame >= begin && frame < end; }
};

/// What the hand and the sensor do.
struct StressCase {
  std::string name;
  int frame_count = 200;
  double speed = 1.0;           ///< 1: the whole arch in the paper's 1000 views
  simulated::PathOptions path;  ///< its duration is set by the speed
  simulated::ViewNoise noise;
  double outlier_share = 0.0;  ///< of the profiles, each off by millimeters as if labelled wrongly
  double missing_share = 0.0;  ///< of the frames, at random
  FrameRange one_pattern;      ///< frames here are lost unless vertical
  FrameRange away;             ///< the sensor is lifted off: nothing, or scraps, in the volume
  double lift_mm = 40.0;       ///< so far
  int jump_frame = 1 << 30;    ///< from here on the hand is `jump_by` frames farther on the path
  int jump_by = 0;
  Twist jump_off = Twist::Zero();  ///< and is moved so, in the sensor frame
};

struct StressScan {
  std::vector<std::shared_ptr<const View>> views;  ///< view i was taken at truth i
  std::vector<Isometry> T_model_sensor;
};

[[nodiscard]] StressScan take_stress_scan(const simulated::ViewSimulator& simulator,
                                          const StressCase& by);

/// A view is right if it lies within `tolerance_mm` of its true place, RMS over a radius of 7 mm,
/// after the scan was laid onto the truth by the largest group of views that agree on how.
struct StressVerdict {
  int right = 0, wrong = 0, rejected = 0;
  double worst_right_mm = 0.0;
};

[[nodiscard]] StressVerdict judge_scan(const std::vector<tracking::RegisteredView>& views,
                                       const StressScan& truth, double tolerance_mm = 0.2);

}  // namespace flytri::testing
