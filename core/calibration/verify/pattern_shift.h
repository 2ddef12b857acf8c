/// @file  Notices during a scan that a projector has moved since the calibration.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/view.h"

namespace flytri::calibration {

/// A larger shift spoils a model. 0.05 mm for teeth; it grows with the distance between the lines.
[[nodiscard]] double harmful_shift_mm(const Vec3& volume_mm);

/// How far the two patterns disagree.
struct PatternShift {
  /// From where the horizontal lines see the surface to where the vertical ones see it, in the
  /// middle of the volume, frame of the sensor.
  Vec3 shift_mm = Vec3::Zero();
  double uncertainty_mm = 0.0;  ///< standard uncertainty of each component
  std::size_t views = 0;        ///< that it was found from
  double harmful_mm = 0.0;      ///< harmful_shift_mm() of the sensor

  /// Whether the sensor should be calibrated again: far more than noise, and enough to spoil
  /// a model.
  [[nodiscard]] bool is_large() const;
};

/// If a projector moves by 20 µm, its lines are measured 0.15 mm too near or too far. Registration
/// hides that: it moves these views until they fit. So the path of the sensor jumps to and fro in
/// step with the patterns. A hand does not: its motion averages out over many views.
class PatternShiftGauge {
 public:
  /// @param volume_mm  of the sensor
  /// @param remembered_s  > 0, what is older is forgotten: long enough to average the hand out,
  ///                      short enough to notice a bump soon
  explicit PatternShiftGauge(const Vec3& volume_mm, double remembered_s = 12.0)
      : harmful_mm_(harmful_shift_mm(volume_mm)), remembered_s_(remembered_s) {}

  /// @param view  the next registered one, by rising time
  void add(const AlignedView& view);
  /// Of what is remembered; none before there are enough views.
  [[nodiscard]] std::optional<PatternShift> shift() const;

  /// How the sensor jumped for one view.
  struct Jump {
    double time_s = 0.0;
    Vec3 shift_mm = Vec3::Zero();
  };
  [[nodiscard]] const std::deque<Jump>& jumps() const { return jumps_; }  ///< by rising time

 private:
  struct Placed {
    Pattern pattern = Pattern::kVertical;
    double time_s = 0.0;
    Isometry T_world_sensor = Isometry::Identity();
  };
  const double harmful_mm_, remembered_s_;
  std::deque<Placed> latest_;  ///< three at most
  std::deque<Jump> jumps_;     ///< by rising time
};

/// Of a whole scan.
/// @param views  registered, by rising time
/// @param volume_mm  of the sensor
[[nodiscard]] std::optional<PatternShift> find_pattern_shift(std::span<const AlignedView> views,
                                                             const Vec3& volume_mm);

/// A time during which the patterns disagreed by the same shift.
struct ShiftedSpan {
  double from_s = 0.0, to_s = 0.0;  ///< of the views; the second is not included
  PatternShift shift;               ///< large
};

/// The parts of a scan with a large shift, by rising time. Where they begin and end is known to a
/// few views only.
/// @param views, volume_mm  as for find_pattern_shift()
[[nodiscard]] std::vector<ShiftedSpan> find_shifted_spans(std::span<const AlignedView> views,
                                                          const Vec3& volume_mm);

}  // namespace flytri::calibration
