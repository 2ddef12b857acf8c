#include "hw/gpio/light_wiring.h"

#include <string_view>

namespace flytri::gpio {

namespace {

Result<void> validate_line(const LineMatch& line, std::string_view light) {
  if (line.name.empty() != line.offset.has_value())
    return fail(ErrorCode::kBadOption, "line of the {} light: give either its name or its number",
                light);
  if (line.offset && *line.offset < 0)
    return fail(ErrorCode::kBadOption, "line {} of the {} light: must be at least 0", *line.offset,
                light);
  return {};
}

bool same(const LineMatch& a, const LineMatch& b) {
  return a.name == b.name && a.offset == b.offset;
}

}  // namespace

Result<void> LightWiring::validate() const {
  if (chip.label.empty() && chip.serial.empty() && chip.bus_path.empty())
    return fail(ErrorCode::kBadOption, "chip of the lights: give its label, serial or bus path");
  if (auto valid = validate_line(vertical, "vertical"); !valid) return valid;
  if (auto valid = validate_line(horizontal, "horizontal"); !valid) return valid;
  if (flash) {
    if (auto valid = validate_line(*flash, "flash"); !valid) return valid;
  }
  if (same(vertical, horizontal) || (flash && (same(*flash, vertical) || same(*flash, horizontal))))
    return fail(ErrorCode::kBadOption, "lines of the lights: two lights have the same one");
  return {};
}

}  // namespace flytri::gpio
