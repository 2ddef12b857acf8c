#include "tests/hardware/usb/light_pins.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace flytri::usb {

void LightPins::set(const std::string& chip, unsigned pins, double now_s) {
  chips_[chip] = pins;
  unsigned all = 0;
  for (const auto& [name, lit] : chips_) all |= lit;
  if (all == edges_.back().pins) return;
  edges_.push_back({now_s, all});
  constexpr double kRemembered_s = 2.0;
  while (edges_.size() > 2 && edges_[1].time_s < now_s - kRemembered_s) edges_.pop_front();
  std::ofstream(log_, std::ios::app) << std::fixed << now_s << ' ' << all << '\n';
}

double LightPins::share(int pin, double from_s, double to_s) const {
  double lit_s = 0.0;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (!(edges_[i].pins >> pin & 1U)) continue;
    const double end_s = i + 1 < edges_.size() ? edges_[i + 1].time_s : to_s;
    lit_s += std::max(0.0, std::min(end_s, to_s) - std::max(edges_[i].time_s, from_s));
  }
  return to_s > from_s ? std::clamp(lit_s / (to_s - from_s), 0.0, 1.0) : 0.0;
}

}  // namespace flytri::usb
