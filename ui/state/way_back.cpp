#include "ui/state/way_back.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flytri::ui {

std::optional<WayBack> way_back(const scan::ScanSnapshot& scan) {
  if (!scan.lost_sensor.T_world_sensor || scan.chosen_reentry >= scan.reentry.size()) {
    return std::nullopt;
  }
  WayBack way;
  way.T_world_sensor = *scan.lost_sensor.T_world_sensor;
  way.T_world_place = scan.reentry[scan.chosen_reentry].first.T_world_sensor;
  const double cosine = way.T_world_sensor.linear().col(2).dot(way.T_world_place.linear().col(2));
  way.tilt_rad = std::acos(std::clamp(cosine, -1.0, 1.0));
  way.is_featureless = scan.lost_sensor.is_featureless;
  return way;
}

std::string words_of(const WayBack& way, const Texts& texts) {
  constexpr double kNotableTilt_deg = 10.0;
  const double tilt_deg = way.tilt_rad * 180.0 / std::numbers::pi, move_mm = way.distance_mm();
  if (tilt_deg < kNotableTilt_deg) {
    return way.is_featureless ? texts.fill<Text::kTooSmoothMove>(move_mm)
                              : texts.fill<Text::kMoveAlongArrow>(move_mm);
  }
  return way.is_featureless ? texts.fill<Text::kTooSmoothMoveAndTilt>(move_mm, tilt_deg)
                            : texts.fill<Text::kMoveAndTilt>(move_mm, tilt_deg);
}

}  // namespace flytri::ui
