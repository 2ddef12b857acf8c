/// @file  Simulated difficult scans with their truth, and the evaluation of their registration.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/tracking/registrar.h"
#include "hw/simulated/optics/sensor_path.h"
#include "hw/simulated/optics/view_noise.h"
#include "hw/simulated/optics/view_simulator.h"

namespace flytri::testing {

/// Frames [begin, end).
struct FrameRange {
  int begin = 0, end = 0;
  [[nodiscard]] bool holds(int frame) const { return frame >= begin && frame < end; }
};

/// Movement of the hand and faults of the sensor.
struct StressCase {
  std::string name;
  int frame_count = 200;
  double speed = 1.0;           ///< 1: the whole arch in 1000 views, as in the paper
  simulated::PathOptions path;  ///< its duration is set from `speed`
  simulated::ViewNoise noise;
  /// Share of profiles that are millimeters off, as with a wrong line index.
  double outlier_share = 0.0;
  double missing_share = 0.0;  ///< share of frames that are missing at random
  FrameRange one_pattern;      ///< in this range, horizontal frames are missing
  FrameRange away;  ///< in this range the sensor is lifted off; little or nothing is in the volume
  double lift_mm = 40.0;  ///< lift height
  /// From this frame on, the hand is `jump_by` frames farther on the path.
  int jump_frame = 1 << 30;
  int jump_by = 0;
  Twist jump_off = Twist::Zero();  ///< additional offset after the jump, in the sensor frame
};

struct StressScan {
  std::vector<std::shared_ptr<const View>> views;  ///< view i was taken at pose i
  std::vector<Isometry> T_model_sensor;
};

[[nodiscard]] StressScan take_stress_scan(const simulated::ViewSimulator& simulator,
                                          const StressCase& by);

/// Number of views by result. A view is right if its RMS distance from its true pose, over a radius
/// of 7 mm, is within `tolerance_mm`. Before, the scan is aligned with the truth by the largest
/// group of consistent views.
struct StressVerdict {
  int right = 0, wrong = 0, rejected = 0;
  double worst_right_mm = 0.0;
};

[[nodiscard]] StressVerdict judge_scan(const std::vector<tracking::RegisteredView>& views,
                                       const StressScan& truth, double tolerance_mm = 0.2);

}  // namespace flytri::testing
