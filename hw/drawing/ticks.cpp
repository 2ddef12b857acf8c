#include "hw/drawing/ticks.h"

#include <cmath>

namespace flytri::drawing {

double tick_step(double length) {
  const double raw = length / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace flytri::drawing
