/// @file  State of the light pins of all chips, with their history.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

namespace flytri::usb {

/// Pins are bits: 0 vertical, 1 horizontal, 2 flash.
class LightPins {
 public:
  /// @param log  file; each change is appended as a line "TIME_S PINS"
  explicit LightPins(std::string log) : log_(std::move(log)) {}

  void set(const std::string& chip, unsigned pins, double now_s);

  /// Share of a time interval in which a pin was on, 0..1. The history covers two seconds.
  [[nodiscard]] double share(int pin, double from_s, double to_s) const;

 private:
  struct Edge {
    double time_s;
    unsigned pins;
  };
  const std::string log_;
  std::map<std::string, unsigned> chips_;
  std::deque<Edge> edges_{{0.0, 0U}};  // never empty
};

}  // namespace flytri::usb
